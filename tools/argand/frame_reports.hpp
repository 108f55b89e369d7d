#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

namespace argand {

/// A file to which each frame adds a line. It holds whole lines only, whatever happens.
class FrameReports {
public:
    /// path: empty for none. The file is made with the first line: then it replaces what was there,
    /// unless the render continues. Throws Error if it continues and a whole line of the file is no
    /// report of a frame.
    FrameReports(const std::string& path, bool continues);

    /// Throws Error if the line cannot be written, such as on a full disk.
    void add(const nlohmann::ordered_json& report);

private:
    std::filesystem::path path_;
    std::ofstream out_;
    std::uintmax_t length_ = 0; ///< of the lines so far, in bytes
};

} // namespace argand
