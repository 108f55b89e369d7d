#include "compare/golden.hpp"

#include "base/atomic_write.hpp"
#include "base/error.hpp"
#include "base/read_file.hpp"
#include "base/text.hpp"

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>
#include <zlib.h>

namespace argand {

namespace {

using Json = nlohmann::json;
using Words = std::vector<std::uint32_t>;

constexpr int format = 2;
constexpr std::uint64_t most_bytes = std::uint64_t(64) << 20;

/// A golden file is compressed by zlib. It contains the number of bytes of a JSON text, the text
/// (padded to a multiple of 4), and the words that the text counts, in its order: for each write
/// its runs, then their contents.
struct Unpacked {
    Json header;
    Words words;
};

std::vector<std::uint8_t> packed(const std::vector<std::uint8_t>& bytes) {
    uLongf size = compressBound(bytes.size());
    std::vector<std::uint8_t> result(sizeof(std::uint64_t) + size);
    const std::uint64_t unpacked = bytes.size();
    std::memcpy(result.data(), &unpacked, sizeof(unpacked));
    compress2(result.data() + sizeof(unpacked), &size, bytes.data(), bytes.size(),
              Z_BEST_COMPRESSION);
    result.resize(sizeof(unpacked) + size);
    return result;
}

Unpacked unpack(const std::vector<std::uint8_t>& bytes) {
    std::uint64_t size = 0;
    if (bytes.size() < sizeof(size)) {
        fail("it is truncated");
    }
    std::memcpy(&size, bytes.data(), sizeof(size));
    if (size > most_bytes || size % sizeof(std::uint32_t) != 0) {
        fail("it is damaged");
    }
    Words words(size / sizeof(std::uint32_t));
    uLongf written = size;
    if (uncompress(reinterpret_cast<Bytef*>(words.data()), &written, bytes.data() + sizeof(size),
                   bytes.size() - sizeof(size)) != Z_OK ||
        written != size || words.empty()) {
        fail("it is damaged");
    }
    const std::uint64_t text_bytes = words.front();
    const std::uint64_t text_words = (text_bytes + 3) / 4;
    if (text_words > words.size() - 1) {
        fail("it is damaged");
    }
    const auto* text = reinterpret_cast<const char*>(words.data() + 1);
    Unpacked result{Json::parse(text, text + text_bytes), {}};
    result.words.assign(words.begin() + 1 + static_cast<std::ptrdiff_t>(text_words), words.end());
    return result;
}

/// Takes words from the front.
class Reader {
public:
    explicit Reader(const Words& words) : words_(words) {}

    std::span<const std::uint32_t> take(std::uint64_t count) {
        if (count > words_.size() - at_) {
            fail("its data are truncated");
        }
        at_ += count;
        return std::span(words_).subspan(at_ - count, count);
    }
    bool at_end() const { return at_ == words_.size(); }

private:
    const Words& words_;
    std::size_t at_ = 0;
};

GoldenWrite read_write(const Json& counts, Reader& reader) {
    GoldenWrite write;
    write.size = counts.at(0).get<std::uint32_t>();
    const std::span<const std::uint32_t> runs = reader.take(2 * counts.at(1).get<std::uint64_t>());
    std::uint64_t total = 0;
    for (std::size_t i = 0; i < runs.size(); i += 2) {
        write.runs.push_back({runs[i], runs[i + 1]});
        total += runs[i + 1];
    }
    const std::span<const std::uint32_t> words = reader.take(total);
    write.words.assign(words.begin(), words.end());
    return write;
}

template <class T> T within(const Json& value, std::uint64_t low, std::uint64_t high) {
    const auto number = value.get<std::int64_t>();
    if (number < 0 || static_cast<std::uint64_t>(number) < low ||
        static_cast<std::uint64_t>(number) > high) {
        fail("its settings are out of range");
    }
    return static_cast<T>(number);
}

std::string line(const Json& value) { return one_line(value.get<std::string>(), 256); }

Golden golden_of(const Unpacked& file) {
    const Json& header = file.header;
    if (header.at("format").get<int>() != format) {
        fail("this version cannot read its format");
    }
    Golden golden;
    golden.scene = line(header.at("scene"));
    golden.fingerprint = header.at("fingerprint").get<std::uint64_t>();
    golden.device = line(header.at("device"));
    golden.driver = line(header.at("driver"));
    golden.revision = line(header.at("revision"));
    golden.features.lane_serial = header.at("lane_serial").get<bool>();
    golden.width = within<int>(header.at("width"), 1, 4096);
    golden.height = within<int>(header.at("height"), 1, 4096);
    golden.samples = within<std::uint32_t>(header.at("samples"), 1, 65536);
    golden.seed = within<std::uint32_t>(header.at("seed"), 0, UINT32_MAX);
    golden.photons = within<std::uint64_t>(header.at("photons"), 0, 100'000'000);
    Reader reader(file.words);
    for (const auto& [method, steps] : header.at("captures").items()) {
        for (const Json& step : steps) {
            GoldenStep& made = golden.captures[one_line(method, 64)].emplace_back();
            made.stage = line(step.at(0));
            for (const Json& counts : step.at(1)) {
                made.writes.push_back(read_write(counts, reader));
            }
        }
    }
    if (golden.captures.empty() || !reader.at_end()) {
        fail("it is empty or has surplus data");
    }
    return golden;
}

} // namespace

GoldenWrite changes(std::span<const std::uint32_t> before, std::span<const std::uint32_t> after) {
    GoldenWrite write;
    write.size = static_cast<std::uint32_t>(after.size());
    for (std::size_t i = 0; i < after.size(); ++i) {
        if (before[i] == after[i]) {
            continue;
        }
        const auto at = static_cast<std::uint32_t>(i);
        if (write.runs.empty() || write.runs.back().first + write.runs.back().count != at) {
            write.runs.push_back({at, 0});
        }
        ++write.runs.back().count;
        write.words.push_back(after[i]);
    }
    return write;
}

void apply_changes(const GoldenWrite& write, std::span<std::uint32_t> words) {
    std::size_t from = 0;
    for (const GoldenWrite::Run& run : write.runs) {
        if (write.size != words.size() || run.count > words.size() ||
            run.first > words.size() - run.count || run.count > write.words.size() - from) {
            fail("comparing with a golden capture: it is of another scene or version; record it "
                 "anew");
        }
        std::copy_n(write.words.begin() + static_cast<std::ptrdiff_t>(from), run.count,
                    words.begin() + static_cast<std::ptrdiff_t>(run.first));
        from += run.count;
    }
}

void write_golden(const std::filesystem::path& file, const Golden& golden) {
    Json captures = Json::object();
    Words words;
    for (const auto& [method, capture] : golden.captures) {
        Json& steps = captures[method] = Json::array();
        for (const GoldenStep& step : capture) {
            Json writes = Json::array();
            for (const GoldenWrite& write : step.writes) {
                writes.push_back({write.size, write.runs.size()});
                for (const GoldenWrite::Run& run : write.runs) {
                    words.insert(words.end(), {run.first, run.count});
                }
                words.insert(words.end(), write.words.begin(), write.words.end());
            }
            steps.push_back({step.stage, std::move(writes)});
        }
    }
    const Json header = {{"format", format},
                         {"scene", golden.scene},
                         {"fingerprint", golden.fingerprint},
                         {"device", golden.device},
                         {"driver", golden.driver},
                         {"revision", golden.revision},
                         {"lane_serial", golden.features.lane_serial},
                         {"width", golden.width},
                         {"height", golden.height},
                         {"samples", golden.samples},
                         {"seed", golden.seed},
                         {"photons", golden.photons},
                         {"captures", std::move(captures)}};
    const std::string text = header.dump(-1, ' ', false, Json::error_handler_t::replace);
    const auto text_bytes = static_cast<std::uint32_t>(text.size());
    std::vector<std::uint8_t> bytes(sizeof(text_bytes) + (text.size() + 3) / 4 * 4);
    std::memcpy(bytes.data(), &text_bytes, sizeof(text_bytes));
    std::memcpy(bytes.data() + sizeof(text_bytes), text.data(), text.size());
    const auto data = std::as_bytes(std::span(words));
    const std::size_t head = bytes.size();
    bytes.resize(head + data.size());
    std::memcpy(bytes.data() + head, data.data(), data.size());
    if (bytes.size() > most_bytes) {
        fail("recording '{}': the capture is larger than {} MiB; use a smaller picture or fewer "
             "photons",
             file.string(), most_bytes >> 20);
    }
    write_atomically(file, packed(bytes));
}

Golden read_golden(const std::filesystem::path& file) {
    const std::vector<std::uint8_t> bytes = read_file(file);
    try {
        return golden_of(unpack(bytes));
    } catch (const Json::exception&) {
        fail("reading golden capture '{}': it is not a capture; record one with `argand "
             "compare-backends "
             "--record`",
             file.string());
    } catch (const Error& error) {
        fail("reading golden capture '{}': {}; record it anew with `argand compare-backends "
             "--record`",
             file.string(), error.what());
    }
}

} // namespace argand
