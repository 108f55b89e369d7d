#pragma once

#include <algorithm>
#include <array>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

/// Reads the include lines of the tree and checks them against the layers in docs/design.md
/// ("Layout").
namespace argand::layering {

/// Source text by path relative to the root of the repository ("engine/scene/gltf.cpp").
using Sources = std::map<std::string, std::string>;

/// The folders of engine/ from the bottom up. Folders on one level must not include each other.
inline const std::vector<std::vector<std::string>> levels = {
    {"base"},
    {"image", "scene", "device"},
    {"plan", "parallel"},
    {"accel"},
    {"world"},
    {"photon", "imagespace"},
    {"methods"},
    {"session"},
    {"autotune", "sweep", "compare"},
    {"plot", "interactive"},
};

/// An include line. `target` is the file that it names, "kernels/..." for a header generated from a
/// kernel, or empty if it is not a file of this repository.
struct Include {
    std::string file;
    std::string path;
    std::string target;
    bool angled = false;
    int line = 0;
};

/// The source file that `path` means when `file` includes it: beside that file or below an include
/// root.
inline std::string resolve(const Sources& sources, const std::string& file, const std::string& path,
                           bool angled) {
    const std::string beside = std::filesystem::path(file).parent_path() / path;
    for (const std::string& candidate :
         {angled ? std::string() : beside, "engine/" + path, "shaders/" + path,
          "shaders/comp/" + path, "tools/" + path}) {
        const std::string normal = std::filesystem::path(candidate).lexically_normal();
        if (sources.contains(normal))
            return normal;
    }
    return path.starts_with("kernels/") ? path : "";
}

/// All include lines, ordered by file.
inline std::vector<Include> includes(const Sources& sources) {
    static const std::regex line_pattern(R"re(^\s*#\s*include\s*(["<])([^">]+)[">].*)re");
    std::vector<Include> found;
    for (const auto& [file, text] : sources) {
        std::istringstream lines(text);
        std::string line;
        for (int number = 1; std::getline(lines, line); ++number) {
            std::smatch match;
            if (!std::regex_match(line, match, line_pattern))
                continue;
            const bool angled = match[1] == "<";
            found.push_back(
                {file, match[2], resolve(sources, file, match[2], angled), angled, number});
        }
    }
    return found;
}

/// The part of the tree to which a file belongs: "base" ... "plot", "tools/X", "shared", "comp"
/// (kernel.glsl), "comp/X", "raster/X", "kernels" (generated), or its first one or two folders.
inline std::string part_of(const std::string& file) {
    std::vector<std::string> folders;
    for (const auto& folder : std::filesystem::path(file).parent_path())
        folders.push_back(folder);
    if (folders.size() > 1 && (folders[0] == "engine" || folders[0] == "shaders"))
        folders.erase(folders.begin());
    const bool one_folder = folders.size() < 2 || (folders[0] != "tools" && folders[0] != "comp" &&
                                                   folders[0] != "raster" && folders[0] != "cuda");
    return folders.empty() ? "" : one_folder ? folders[0] : folders[0] + "/" + folders[1];
}

/// Level of a folder of engine/, with the tools above all; -1 for other parts.
inline int level_of(const std::string& part) {
    if (part.starts_with("tools/"))
        return static_cast<int>(levels.size());
    for (std::size_t i = 0; i < levels.size(); ++i)
        if (std::find(levels[i].begin(), levels[i].end(), part) != levels[i].end())
            return static_cast<int>(i);
    return -1;
}

/// Reason why a file of part `from` must not include one of part `to`; empty if it may.
inline std::string objection(const std::string& from, const std::string& to) {
    if (from == to)
        return "";
    if (from == "shared")
        return "shaders/shared sees only itself";
    const std::string kind = from.substr(0, from.find('/'));
    // Twins are shared code compiled against headers generated from kernels with the same
    // declarations.
    if (kind == "cuda")
        return to == "shared" || to == "cuda" || to == "kernels" || to == "device"
                   ? ""
                   : "twins see only shaders/shared, shaders/cuda, device and generated kernels";
    if (kind == "comp" || kind == "raster")
        return to == "shared" || to == "comp"
                   ? ""
                   : "kernels see only shaders/shared and their own folder";
    const int level = level_of(from);
    if (level < 0)
        return fmt::format("{} has no place in the order of docs/design.md", from);
    if (to == "shared")
        return level > 0 && from != "image"
                   ? ""
                   : "shaders/shared is for scene, device and what is above";
    if (to == "kernels")
        return from == "device" || level > 1 ? "" : "kernels are for device and what is above";
    const int other = level_of(to);
    if (other < 0)
        return fmt::format("{} has no place in the order of docs/design.md", to);
    if (other == level)
        return fmt::format("{} and {} stand side by side", from, to);
    return other < level ? "" : fmt::format("{} stands above {}", to, from);
}

/// A cycle of includes through `file`, or nothing. `done` holds files known to be on no cycle.
inline std::vector<std::string>
include_cycle(const std::map<std::string, std::set<std::string>>& graph, const std::string& file,
              std::vector<std::string>& path, std::set<std::string>& done) {
    const auto seen = std::find(path.begin(), path.end(), file);
    if (seen != path.end()) {
        std::vector<std::string> found(seen, path.end());
        found.push_back(file);
        return found;
    }
    const auto node = graph.find(file);
    if (node == graph.end() || done.contains(file))
        return {};
    path.push_back(file);
    for (const std::string& next : node->second)
        if (auto found = include_cycle(graph, next, path, done); !found.empty())
            return found;
    path.pop_back();
    done.insert(file);
    return {};
}

/// Includes that violate the layers, and the first cycle of includes, one line each.
inline std::vector<std::string> faults(const Sources& sources) {
    std::vector<std::string> found;
    std::map<std::string, std::set<std::string>> graph;
    for (const Include& include : includes(sources)) {
        std::string why;
        if (!include.target.empty()) {
            graph[include.file].insert(include.target);
            why = objection(part_of(include.file), part_of(include.target));
        } else if (!include.angled) {
            why = "no such file in this repository (libraries stand between angle brackets)";
        }
        if (!why.empty())
            found.push_back(fmt::format("{}:{}: includes {}: {}", include.file, include.line,
                                        include.path, why));
    }
    std::vector<std::string> path;
    std::set<std::string> done;
    for (const auto& [file, targets] : graph) {
        if (const auto files = include_cycle(graph, file, path, done); !files.empty()) {
            found.push_back(fmt::format("files include each other: {}", fmt::join(files, " > ")));
            break;
        }
    }
    return found;
}

/// The C++, GLSL and CUDA sources below these folders of `root`.
inline Sources read_sources(const std::filesystem::path& root,
                            const std::vector<std::string>& folders) {
    static constexpr std::array extensions = {".hpp",  ".cpp",  ".h",    ".glsl",
                                              ".comp", ".vert", ".frag", ".cu"};
    Sources sources;
    for (const std::string& folder : folders) {
        if (!std::filesystem::exists(root / folder))
            continue;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder)) {
            const std::string extension = entry.path().extension();
            if (std::find(extensions.begin(), extensions.end(), extension) == extensions.end())
                continue;
            std::ifstream stream(entry.path());
            sources[std::filesystem::relative(entry.path(), root)] = {
                std::istreambuf_iterator<char>(stream), {}};
        }
    }
    return sources;
}

} // namespace argand::layering
