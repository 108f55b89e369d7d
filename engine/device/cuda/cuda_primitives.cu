#include "device/cuda/cuda_device.hpp"
#include "shared/geometry_records.h"
#include "shared/parallel_records.h"

#include <cub/cub.cuh>
#include <cuda/std/limits>
#include <thrust/iterator/counting_iterator.h>
#include <thrust/iterator/transform_iterator.h>
#include <thrust/iterator/transform_output_iterator.h>

namespace argand::cuda {

namespace {

template <class T> T* pointer_of(const Buffer& buffer) {
    return static_cast<T*>(block_of<CudaBlock>(buffer).pointer);
}

/// A sum, and whether a segment starts within the summed elements.
struct SegmentSum {
    uint sum;
    uint head;
};

struct ReadSegmentSum {
    const uint* in;
    const uint* heads;
    __device__ SegmentSum operator()(std::uint64_t i) const {
        return {in[i], heads[i] != 0 ? 1u : 0u};
    }
};

struct AddSegmentSums {
    __device__ SegmentSum operator()(const SegmentSum& a, const SegmentSum& b) const {
        return {b.head != 0 ? b.sum : a.sum + b.sum, a.head | b.head};
    }
};

struct OnlySum {
    __device__ uint operator()(const SegmentSum& s) const { return s.sum; }
};

struct UniteBoxes {
    __device__ BoxRecord operator()(const BoxRecord& a, const BoxRecord& b) const {
        return {min(a.low_x, b.low_x),   min(a.low_y, b.low_y),   min(a.low_z, b.low_z),   0,
                max(a.high_x, b.high_x), max(a.high_y, b.high_y), max(a.high_z, b.high_z), 0};
    }
};

struct NotZero {
    __device__ bool operator()(uint x) const { return x != 0; }
};

class CubPrimitives final : public Primitives {
public:
    CubPrimitives(Device& device, cudaStream_t stream) : device_(device), stream_(stream) {}

    void sort(const Buffer& keys, const Buffer& values, const Count& count, std::uint32_t bits,
              std::uint32_t key_words) override {
        if (key_words == 2) {
            sort_keys<std::uint64_t>(keys, values, count, bits);
        } else {
            sort_keys<std::uint32_t>(keys, values, count, bits);
        }
    }

    void scan(const Buffer& in, const Buffer& out, const Count& count, bool inclusive) override {
        const std::uint64_t n = number_of(count);
        with_storage("scanning", [&](void* storage, std::size_t& bytes) {
            return inclusive ? cub::DeviceScan::InclusiveSum(storage, bytes, pointer_of<uint>(in),
                                                             pointer_of<uint>(out), n, stream_)
                             : cub::DeviceScan::ExclusiveSum(storage, bytes, pointer_of<uint>(in),
                                                             pointer_of<uint>(out), n, stream_);
        });
    }

    void segmented_scan(const Buffer& in, const Buffer& heads, const Buffer& out,
                        const Count& count) override {
        const std::uint64_t n = number_of(count);
        const auto from = thrust::make_transform_iterator(
            thrust::counting_iterator<std::uint64_t>(0),
            ReadSegmentSum{pointer_of<uint>(in), pointer_of<uint>(heads)});
        const auto to = thrust::make_transform_output_iterator(pointer_of<uint>(out), OnlySum{});
        with_storage("scanning segments", [&](void* storage, std::size_t& bytes) {
            return cub::DeviceScan::InclusiveScan(storage, bytes, from, to, AddSegmentSums{}, n,
                                                  stream_);
        });
    }

    void reduce(const Buffer& in, const Buffer& out, std::uint32_t out_index, const Count& count,
                std::uint32_t op) override {
        const std::uint64_t n = number_of(count);
        const uint* from = pointer_of<uint>(in);
        uint* to = pointer_of<uint>(out) + out_index;
        with_storage("reducing", [&](void* storage, std::size_t& bytes) {
            return op == reduce_op_min
                       ? cub::DeviceReduce::Min(storage, bytes, from, to, n, stream_)
                   : op == reduce_op_max
                       ? cub::DeviceReduce::Max(storage, bytes, from, to, n, stream_)
                       : cub::DeviceReduce::Sum(storage, bytes, from, to, n, stream_);
        });
    }

    void reduce_box(const Buffer& boxes, const Buffer& out, std::uint32_t out_index,
                    const Count& count) override {
        const std::uint64_t n = number_of(count);
        constexpr float infinity = ::cuda::std::numeric_limits<float>::infinity();
        const BoxRecord nothing{infinity,  infinity,  infinity,  0,
                                -infinity, -infinity, -infinity, 0};
        with_storage("reducing boxes", [&](void* storage, std::size_t& bytes) {
            return cub::DeviceReduce::Reduce(storage, bytes, pointer_of<BoxRecord>(boxes),
                                             pointer_of<BoxRecord>(out) + out_index, n,
                                             UniteBoxes{}, nothing, stream_);
        });
    }

    void compact(const Buffer& flags, const Buffer& values, const Buffer& out, const Buffer& counts,
                 std::uint32_t count_index, const Count& count) override {
        const std::uint64_t n = number_of(count);
        const auto kept = thrust::make_transform_iterator(pointer_of<uint>(flags), NotZero{});
        with_storage("compacting", [&](void* storage, std::size_t& bytes) {
            return cub::DeviceSelect::Flagged(storage, bytes, pointer_of<uint>(values), kept,
                                              pointer_of<uint>(out),
                                              pointer_of<uint>(counts) + count_index, n, stream_);
        });
    }

private:
    /// CUB needs counts on the host, so this waits for a count that is on the device.
    std::uint64_t number_of(const Count& count) {
        if (!count.on_device()) {
            return count.bound;
        }
        const uint number = download<uint>(device_, count.buffer, 1, count.index).front();
        return number < count.bound ? number : count.bound;
    }

    /// Calls `call` to get the size of the temporary storage, then again with the storage.
    template <class Call> void with_storage(const char* doing, const Call& call) {
        std::size_t bytes = 0;
        check(call(nullptr, bytes), doing, device_.info().name);
        const Buffer storage = device_.scratch("cub: temporary storage", bytes);
        check(call(pointer_of<void>(storage), bytes), doing, device_.info().name);
    }

    template <class Key>
    void sort_keys(const Buffer& keys, const Buffer& values, const Count& count,
                   std::uint32_t bits) {
        const std::uint64_t n = number_of(count);
        if (n < 2) {
            return;
        }
        const int end_bit = static_cast<int>(bits < 8 * sizeof(Key) ? bits : 8 * sizeof(Key));
        const Buffer other_keys = device_.scratch("sort: keys", n * sizeof(Key));
        cub::DoubleBuffer<Key> key_sides(pointer_of<Key>(keys), pointer_of<Key>(other_keys));
        if (!values) {
            with_storage("sorting", [&](void* storage, std::size_t& bytes) {
                return cub::DeviceRadixSort::SortKeys(storage, bytes, key_sides, n, 0, end_bit,
                                                      stream_);
            });
        } else {
            const Buffer other_values = device_.scratch("sort: values", n * sizeof(uint));
            cub::DoubleBuffer<uint> value_sides(pointer_of<uint>(values),
                                                pointer_of<uint>(other_values));
            with_storage("sorting", [&](void* storage, std::size_t& bytes) {
                return cub::DeviceRadixSort::SortPairs(storage, bytes, key_sides, value_sides, n, 0,
                                                       end_bit, stream_);
            });
            if (value_sides.Current() != pointer_of<uint>(values)) {
                device_.copy(BufferView(other_values, 0, n * sizeof(uint)), values);
            }
        }
        if (key_sides.Current() != pointer_of<Key>(keys)) {
            device_.copy(BufferView(other_keys, 0, n * sizeof(Key)), keys);
        }
    }

    Device& device_;
    cudaStream_t stream_;
};

__global__ void fill_kernel(std::uint32_t* to, std::uint64_t count, std::uint32_t value) {
    for (std::uint64_t i = blockIdx.x * std::uint64_t(blockDim.x) + threadIdx.x; i < count;
         i += std::uint64_t(gridDim.x) * blockDim.x) {
        to[i] = value;
    }
}

} // namespace

void fill_words(void* to, std::uint64_t count, std::uint32_t value, cudaStream_t stream) {
    if (count > 0) {
        const std::uint64_t groups = (count + 255) / 256;
        fill_kernel<<<static_cast<unsigned>(groups < 4096 ? groups : 4096), 256, 0, stream>>>(
            static_cast<std::uint32_t*>(to), count, value);
    }
}

std::unique_ptr<Primitives> make_primitives(Device& device, cudaStream_t stream) {
    return std::make_unique<CubPrimitives>(device, stream);
}

} // namespace argand::cuda
