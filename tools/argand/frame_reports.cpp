#include "frame_reports.hpp"

#include "base/error.hpp"
#include "base/json.hpp"
#include "base/read_file.hpp"
#include "base/text.hpp"

#include <string_view>

namespace argand {

namespace {

namespace fs = std::filesystem;

/// Bytes of the whole lines of a file. Throws Error if one of them is not of a frame.
std::uintmax_t length_of_lines(const fs::path& path) {
    const std::vector<std::uint8_t> bytes = read_file(path);
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    std::size_t begin = 0;
    for (std::size_t line = 1;; ++line) {
        const std::size_t end = text.find('\n', begin);
        if (end == std::string_view::npos) {
            return begin;
        }
        const nlohmann::json report =
            nlohmann::json::parse(text.substr(begin, end - begin), nullptr, false);
        if (!report.is_object() || !report.contains("frame")) {
            fail("continuing '{}': line {} is no report of a frame; give --json another file",
                 one_line(path.string()), line);
        }
        begin = end + 1;
    }
}

} // namespace

FrameReports::FrameReports(const std::string& path, bool continues) : path_(path) {
    std::error_code none;
    if (continues && fs::is_regular_file(path_, none)) {
        length_ = length_of_lines(path_);
    }
}

void FrameReports::add(const nlohmann::ordered_json& report) {
    if (path_.empty()) {
        return;
    }
    std::error_code problem;
    if (!out_.is_open()) {
        if (length_ > 0) {
            fs::resize_file(path_, length_, problem);
        }
        if (problem) {
            fail("continuing '{}': {}; check its permissions", one_line(path_.string()),
                 problem.message());
        }
        out_.open(path_, length_ > 0 ? std::ios::app : std::ios::trunc);
    }
    const std::string line = json_text(report, one_line_of_json);
    out_ << line << std::flush;
    if (!out_) {
        out_.close();
        fs::resize_file(path_, length_, problem); // a pipe or a device has no size
        fail("writing '{}': the disk is full, or it cannot be written to; no more frames are "
             "rendered",
             one_line(path_.string()));
    }
    length_ += line.size();
}

} // namespace argand
