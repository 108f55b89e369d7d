#include "scene/gltf_file.hpp"

#include "base/read_file.hpp"
#include "scene/gltf_check.hpp"
#include "scene/gltf_compression.hpp"
#include "scene/gltf_numbers.hpp"
#include "scene/gltf_uri.hpp"
#include <cstring>
#include <deque>
#include <span>
#include <sstream>
#include <string>
#include <string_view>

namespace argand {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// The contents of a .gltf or .glb, as views into the file's bytes.
struct Container {
    std::string_view json;
    std::span<const std::uint8_t> binary; ///< the BIN chunk, empty if there is none
    bool is_glb = false;
};

std::uint32_t word(std::span<const std::uint8_t> bytes, std::size_t at) {
    return std::uint32_t(bytes[at]) | std::uint32_t(bytes[at + 1]) << 8 |
           std::uint32_t(bytes[at + 2]) << 16 | std::uint32_t(bytes[at + 3]) << 24;
}

void put_word(Bytes& bytes, std::uint32_t value) {
    for (int shift = 0; shift < 32; shift += 8) {
        bytes.push_back(static_cast<std::uint8_t>(value >> shift));
    }
}

std::string_view text_of(std::span<const std::uint8_t> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

constexpr std::uint32_t magic = 0x46546c67;        // "glTF"
constexpr std::uint32_t json_chunk = 0x4e4f534a;   // "JSON"
constexpr std::uint32_t binary_chunk = 0x004e4942; // "BIN\0"

/// glTF 2.0 specification, section 4.4 (binary glTF layout).
Container open_glb(std::span<const std::uint8_t> bytes) {
    if (bytes.size() < 12) {
        fail("the file is truncated within the 12 bytes of its header");
    }
    if (word(bytes, 4) != 2) {
        fail("it is a binary glTF of version {}; only version 2 is supported", word(bytes, 4));
    }
    const std::size_t length = word(bytes, 8);
    if (length > bytes.size()) {
        fail("the file is truncated: its header says {} bytes, there are {}", length, bytes.size());
    }
    Container container;
    container.is_glb = true;
    for (std::size_t at = 12, chunk = 0; at < length; ++chunk) {
        if (length - at < 8 || length - at - 8 < word(bytes, at)) {
            fail("chunk {} of the binary glTF goes past the end of the file", chunk);
        }
        const std::uint32_t size = word(bytes, at);
        const std::uint32_t type = word(bytes, at + 4);
        const std::span<const std::uint8_t> data = bytes.subspan(at + 8, size);
        if (chunk == 0) {
            if (type != json_chunk) {
                fail("the first chunk of the binary glTF is not JSON");
            }
            container.json = text_of(data);
        } else if (chunk == 1 && type == binary_chunk) {
            container.binary = data;
        } // the specification says to ignore other chunks
        at += 8 + std::size_t(size);
        at += (4 - at % 4) % 4;
    }
    if (container.json.empty()) {
        fail("the binary glTF has no JSON chunk");
    }
    return container;
}

Container open_container(std::span<const std::uint8_t> bytes) {
    if (bytes.empty()) {
        fail("the file is empty");
    }
    if (bytes.size() >= 4 && word(bytes, 0) == magic) {
        return open_glb(bytes);
    }
    return {text_of(bytes), {}, false};
}

/// Writes the container anew with exact lengths and padding. tinygltf reads beyond the end of some
/// truncated files and rejects an empty BIN chunk.
Bytes make_glb(const Container& container) {
    const std::size_t json_size = (container.json.size() + 3) / 4 * 4;
    const std::size_t binary_size = (container.binary.size() + 3) / 4 * 4;
    const std::size_t total = 20 + json_size + (binary_size > 0 ? 8 + binary_size : 0);
    if (total > 0xffffffff) {
        fail("the binary glTF is longer than its 32-bit length can say");
    }
    Bytes glb;
    glb.reserve(total);
    put_word(glb, magic);
    put_word(glb, 2);
    put_word(glb, static_cast<std::uint32_t>(total));
    put_word(glb, static_cast<std::uint32_t>(json_size));
    put_word(glb, json_chunk);
    glb.insert(glb.end(), container.json.begin(), container.json.end());
    glb.resize(20 + json_size, ' ');
    if (binary_size > 0) {
        put_word(glb, static_cast<std::uint32_t>(binary_size));
        put_word(glb, binary_chunk);
        glb.insert(glb.end(), container.binary.begin(), container.binary.end());
        glb.resize(total, 0);
    }
    return glb;
}

/// External files of the buffers, in the order in which tinygltf reads them. Anything that it
/// requests after them is an image.
struct ExternalFiles {
    struct Buffer {
        std::filesystem::path path;
        std::string uri;  ///< for messages
        std::size_t size; ///< bytes required; the file may be longer
    };
    std::filesystem::path directory;
    std::deque<Buffer> pending;
    std::string problem; ///< error message for the user
};

ExternalFiles list_external_files(const nlohmann::json& root, const std::filesystem::path& path,
                                  bool is_glb, bool allow_external) {
    ExternalFiles files;
    files.directory = path.parent_path();
    const auto buffers = root.find("buffers");
    if (buffers == root.end() || !buffers->is_array()) {
        return files;
    }
    for (std::size_t i = 0; i < buffers->size(); ++i) {
        const nlohmann::json& buffer = (*buffers)[i];
        const bool has_uri =
            buffer.is_object() && buffer.contains("uri") && buffer["uri"].is_string();
        if (!has_uri && (!is_glb || i > 0)) { // only the first buffer can be the BIN chunk
            fail("buffer {} has no uri, so there is no data for it", i);
        }
        if (!has_uri || !buffer.contains("byteLength") ||
            !buffer["byteLength"].is_number_unsigned()) {
            continue; // tinygltf reports the mistake
        }
        const std::string uri = buffer["uri"];
        if (uri.empty() || tinygltf::IsDataURI(uri)) {
            continue;
        }
        files.pending.push_back(
            {path_of_uri(files.directory, uri, fmt::format("buffer {}", i), allow_external),
             one_line(uri), buffer["byteLength"].get<std::size_t>()});
    }
    return files;
}

bool file_exists(const std::string&, void* user) {
    return !static_cast<ExternalFiles*>(user)->pending.empty();
}

std::string expand_path(const std::string& path, void*) { return path; }

bool read_external(Bytes* out, std::string*, const std::string&, void* user) {
    auto& files = *static_cast<ExternalFiles*>(user);
    const ExternalFiles::Buffer buffer = files.pending.front();
    files.pending.pop_front();
    try {
        *out = read_file(buffer.path);
        if (out->size() < buffer.size) {
            fail("'{}' has {} bytes where {} are required", buffer.uri, out->size(), buffer.size);
        }
        out->resize(buffer.size);
        return true;
    } catch (const std::exception& problem) {
        files.problem = problem.what();
        return false;
    }
}

bool write_nothing(std::string*, const std::string&, const Bytes&, void*) { return false; }

bool keep_image_undecoded(tinygltf::Image*, int, std::string*, std::string*, int, int,
                          const unsigned char*, int, void*) {
    return true;
}

/// The reader's complaints, a line each, without those about what glTF allows to be missing: the
/// matrices of a skin, and the node of an animation's target.
std::string without_false_ones(const std::string& complaints) {
    std::istringstream lines(complaints);
    std::string kept;
    for (std::string line; std::getline(lines, line);) {
        const bool is_false = line.find("'inverseBindMatrices' property is missing") == 0 ||
                              line.find("'node' property is missing") == 0 ||
                              line.find("`node` field is missing in animation") == 0;
        kept += is_false ? "" : line + "\n";
    }
    return kept;
}

void parse(const std::filesystem::path& path, GltfSource& source, std::vector<std::string>& notes) {
    const Bytes bytes = read_file(path);
    Container container = open_container(bytes);
    source.root = parse_gltf_json(container.json);
    check_gltf_version(source.root);
    const bool rewritten = rewrite_integers(source.root);
    const bool filled = fill_fallback_buffers(source.root);
    std::string text; // what tinygltf reads, if it does not understand what the file says
    if (give_indices_views(source.root) || filled || rewritten) {
        text = source.root.dump();
        container.json = text;
    }
    check_gltf_json(source.root);

    ExternalFiles files =
        list_external_files(source.root, path, container.is_glb, source.options.allow_external);
    tinygltf::TinyGLTF reader;
    reader.SetFsCallbacks({file_exists, expand_path, read_external, write_nothing, &files});
    reader.SetImageLoader(keep_image_undecoded, nullptr);
    std::string problem;
    std::string warning;
    bool good = false;
    try {
        if (container.is_glb) {
            const Bytes glb = make_glb(container);
            good = reader.LoadBinaryFromMemory(&source.model, &problem, &warning, glb.data(),
                                               static_cast<unsigned>(glb.size()), "");
        } else {
            if (container.json.size() > 0xffffffff) {
                fail("its JSON is longer than 4 GiB");
            }
            good =
                reader.LoadASCIIFromString(&source.model, &problem, &warning, container.json.data(),
                                           static_cast<unsigned>(container.json.size()), "");
        }
    } catch (const Error&) {
        throw;
    } catch (const std::exception& unexpected) {
        fail("it is not valid glTF ({})", one_line(unexpected.what()));
    }
    if (!files.problem.empty()) {
        fail("{}", files.problem);
    }
    if (!good) {
        fail("it is not valid glTF: {}",
             problem.empty() ? "the reader gives no reason" : one_line(problem));
    }
    const std::string complaints = without_false_ones(problem);
    if (!complaints.empty()) {
        notes.push_back(fmt::format("not quite valid glTF: {}", one_line(complaints)));
    }
}

} // namespace

GltfSource read_gltf_file(const std::filesystem::path& path, const LoadOptions& options,
                          std::vector<std::string>& notes) {
    GltfSource source;
    source.options = options;
    source.file = one_line(path.string());
    source.directory = path.parent_path();
    try {
        parse(path, source, notes);
        decompress(source);
    } catch (const Error& problem) {
        const std::string message = problem.what();
        if (message.starts_with("cannot read '" + source.file) ||
            message.starts_with("cannot load '" + source.file)) {
            throw; // already a complete message
        }
        source.fail("{}", message);
    }
    return source;
}

} // namespace argand
