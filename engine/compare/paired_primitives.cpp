#include "compare/paired_primitives.hpp"

#include "compare/paired_device.hpp"
#include "parallel/compact.hpp"
#include "parallel/radix_sort.hpp"
#include "parallel/reduce.hpp"
#include "parallel/scan.hpp"
#include "shared/parallel_records.h"

namespace argand {

namespace {

using Side = Buffer PairedBuffer::*;

Buffer side_of(const Buffer& buffer, Side side) {
    return buffer ? static_cast<PairedBuffer&>(*buffer.storage()).*side : Buffer();
}

Count side_of(const Count& count, Side side) {
    return count.on_device() ? Count(side_of(count.buffer, side), count.index, count.bound) : count;
}

class PairedPrimitives final : public Primitives {
public:
    PairedPrimitives(PairedDevice& pair, Device& a, Device& b) : pair_(pair), a_(a), b_(b) {}

    void sort(const Buffer& keys, const Buffer& values, const Count& count, std::uint32_t bits,
              std::uint32_t key_words) override {
        const auto work = [&](Device& device, Side side) {
            const Count n = side_of(count, side);
            if (key_words == 2) {
                radix_sort_pairs64(device, side_of(keys, side), side_of(values, side), n, bits);
            } else if (values) {
                radix_sort_pairs(device, side_of(keys, side), side_of(values, side), n, bits);
            } else {
                radix_sort(device, side_of(keys, side), n, bits);
            }
        };
        std::vector<WrittenBinding> written{words(keys)};
        if (values) {
            written.push_back(words(values));
        }
        run(sort_stage, work, written);
    }

    void scan(const Buffer& in, const Buffer& out, const Count& count, bool inclusive) override {
        const auto work = [&](Device& device, Side side) {
            const auto scan = inclusive ? inclusive_scan : exclusive_scan;
            scan(device, side_of(in, side), side_of(out, side), side_of(count, side));
        };
        run(scan_stage, work, {words(out)});
    }

    void segmented_scan(const Buffer& in, const Buffer& heads, const Buffer& out,
                        const Count& count) override {
        const auto work = [&](Device& device, Side side) {
            argand::segmented_scan(device, side_of(in, side), side_of(heads, side),
                                   side_of(out, side), side_of(count, side));
        };
        run(segmented_scan_stage, work, {words(out)});
    }

    void reduce(const Buffer& in, const Buffer& out, std::uint32_t out_index, const Count& count,
                std::uint32_t op) override {
        const auto work = [&](Device& device, Side side) {
            const auto reduce = op == reduce_op_min   ? reduce_min
                                : op == reduce_op_max ? reduce_max
                                                      : reduce_sum;
            reduce(device, side_of(in, side), side_of(out, side), out_index, side_of(count, side));
        };
        run(reduce_stage, work, {words(out)});
    }

    void reduce_box(const Buffer& boxes, const Buffer& out, std::uint32_t out_index,
                    const Count& count) override {
        const auto work = [&](Device& device, Side side) {
            argand::reduce_box(device, side_of(boxes, side), side_of(out, side), out_index,
                               side_of(count, side));
        };
        run(reduce_box_stage, work, {words(out)});
    }

    void compact(const Buffer& flags, const Buffer& values, const Buffer& out, const Buffer& counts,
                 std::uint32_t count_index, const Count& count) override {
        const auto work = [&](Device& device, Side side) {
            argand::compact(device, side_of(flags, side), side_of(values, side), side_of(out, side),
                            {side_of(counts, side), count_index}, side_of(count, side));
        };
        run(compact_stage, work, {words(out), words(counts)});
    }

private:
    static WrittenBinding words(const Buffer& buffer) {
        return {buffer, {.name = "", .binding = 0, .access = Access::write}};
    }

    template <class Work>
    void run(const char* stage, const Work& work, const std::vector<WrittenBinding>& written) {
        pair_.run(
            stage, [&] { work(a_, &PairedBuffer::a); }, [&] { work(b_, &PairedBuffer::b); },
            written);
    }

    PairedDevice& pair_;
    Device& a_;
    Device& b_;
};

} // namespace

std::unique_ptr<Primitives> make_paired_primitives(PairedDevice& pair, Device& a, Device& b) {
    return std::make_unique<PairedPrimitives>(pair, a, b);
}

} // namespace argand
