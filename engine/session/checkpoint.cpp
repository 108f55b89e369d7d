#include "session/checkpoint.hpp"

#include "base/archive.hpp"
#include "base/atomic_write.hpp"
#include "base/machine.hpp"
#include "base/read_file.hpp"
#include "base/same_file.hpp"
#include "base/text.hpp"
#include "scene/fingerprint.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <optional>

namespace argand {

namespace {

namespace fs = std::filesystem;

// The last byte is the format's version.
constexpr std::array<std::uint8_t, 8> magic = {'A', 'r', 'g', 'a', 'n', 'd', 'C', '2'};

/// Precedes the contents of a checkpoint.
struct Header {
    std::array<std::uint8_t, 8> start = magic;
    std::uint64_t length = 0;   ///< of what follows, in bytes
    std::uint64_t checksum = 0; ///< of what follows
};

std::string name_of(const fs::path& path) { return one_line(path.string()); }

/// The path after symbolic links, which stay links.
fs::path place_of(const fs::path& path) {
    std::error_code problem;
    const bool links = fs::is_symlink(path, problem);
    return links ? fs::weakly_canonical(path, problem) : path;
}

enum class Content : std::uint8_t { nothing, checkpoint, other };

/// What a path has, as far as its first bytes and its length tell.
Content content_of(const fs::path& path) {
    std::error_code problem;
    const fs::file_status status = fs::status(path, problem);
    if (status.type() == fs::file_type::not_found) {
        return Content::nothing;
    }
    if (problem || !fs::is_regular_file(status)) {
        return Content::other;
    }
    Header header;
    std::ifstream in(path, std::ios::binary);
    in.read(reinterpret_cast<char*>(&header), sizeof(header));
    return in && header.start == magic &&
                   fs::file_size(path, problem) == sizeof(header) + header.length
               ? Content::checkpoint
               : Content::other;
}

/// What follows the header of a checkpoint. Throws Error if the file is not a whole checkpoint.
std::vector<std::uint8_t> read_contents(const fs::path& path) {
    std::vector<std::uint8_t> bytes = read_file(path);
    Header header;
    if (bytes.size() < sizeof(header) ||
        !std::equal(magic.begin(), magic.end() - 1, bytes.begin())) {
        fail("reading '{}': it is not a checkpoint", name_of(path));
    }
    if (bytes[magic.size() - 1] != magic.back()) {
        fail("reading '{}': it is a checkpoint of another version of Argand", name_of(path));
    }
    Archive archive(bytes);
    archive.value(header);
    bytes.erase(bytes.begin(), bytes.begin() + sizeof(header));
    if (bytes.size() != header.length) {
        fail("reading '{}': it has {} of {} bytes", name_of(path), bytes.size(), header.length);
    }
    if (fingerprint(std::as_bytes(std::span(bytes))) != header.checksum) {
        fail("reading '{}': it is damaged", name_of(path));
    }
    return bytes;
}

void persist_key(Archive& archive, CheckpointKey& key) {
    std::uint64_t count = key.size();
    archive.value(count);
    for (std::uint64_t i = 0; i < count; ++i) {
        if (archive.loads()) {
            key.emplace_back();
        }
        archive.text(key[i].first);
        archive.text(key[i].second);
    }
}

/// Throws Error if the checkpoint's key is another one.
void check_key(const fs::path& path, const CheckpointKey& found, const CheckpointKey& wanted) {
    for (std::size_t i = 0; i < std::max(found.size(), wanted.size()); ++i) {
        if (i >= found.size() || i >= wanted.size() || found[i].first != wanted[i].first) {
            fail("resuming '{}': it is of another method or version of Argand; render from the "
                 "start",
                 name_of(path));
        }
        if (found[i].second != wanted[i].second) {
            fail("resuming '{}': its {} is {}, and not {}; resume with what it was begun with, or "
                 "render from the start",
                 name_of(path), found[i].first, found[i].second, wanted[i].second);
        }
    }
}

/// The key of a file, or none if it is not a whole checkpoint.
std::optional<CheckpointKey> key_of(const fs::path& path) try {
    const std::vector<std::uint8_t> contents = read_contents(path);
    Archive archive(contents);
    CheckpointKey key;
    persist_key(archive, key);
    return key;
} catch (const Error&) {
    return std::nullopt;
}

std::vector<std::uint8_t> state_of(const fs::path& path, std::span<const std::uint8_t> contents,
                                   const CheckpointKey& wanted) {
    Archive archive(contents);
    CheckpointKey key;
    persist_key(archive, key);
    check_key(path, key, wanted);
    std::vector<std::uint8_t> state;
    archive.values(state);
    return state;
}

std::string crop_text(const RenderSettings& settings) {
    const auto& crop = settings.crop;
    return crop ? fmt::format("{},{},{},{}", crop->x0, crop->y0, crop->x1, crop->y1) : "none";
}

} // namespace

CheckpointKey checkpoint_key(const Scene& scene, const RenderSettings& settings,
                             const MethodInfo& method, const DeviceInfo& device) {
    CheckpointKey key{{"build", program_fingerprint()},
                      {"scene", fmt::format("{} ({:016x})", scene.name,
                                            picture_fingerprint(scene, settings.camera))},
                      {"method", settings.method},
                      {"size", fmt::format("{}x{}", settings.width, settings.height)},
                      {"crop", crop_text(settings)},
                      {"seed", fmt::format("{}", settings.seed)},
                      {"backend", device.backend},
                      {"device", fmt::format("{}, {}", device.name, device.driver)},
                      {"budget", settings.budget ? "given" : "none"},
                      {"division into passes",
                       fmt::format("{} photons, {} samples, {} passes", settings.photons_per_pass,
                                   settings.samples_per_pass, settings.least_passes)},
                      {"--everything", settings.everything ? "on" : "off"}};
    for (const Option& option : method.options) {
        if (!option.ends_render) {
            key.emplace_back("--" + option.name, option.get(settings));
        }
    }
    return key;
}

fs::path older_checkpoint(const fs::path& path) {
    fs::path older = place_of(path);
    older += ".old";
    return older;
}

void check_checkpoint_writable(const fs::path& path, const fs::path& resumed) {
    check_writable(path);
    const fs::path older = older_checkpoint(path);
    const Content last = content_of(place_of(path)), before = content_of(older);
    // A damaged checkpoint gives way if there is the one before it.
    if (last == Content::other && before != Content::checkpoint) {
        fail("writing the checkpoint '{}': there is something else of that name; choose another "
             "name",
             name_of(path));
    }
    if (before == Content::other) {
        fail("writing the checkpoint '{}': it would replace '{}', which is something else; choose "
             "another name",
             name_of(path), name_of(older));
    }
    if ((last == Content::checkpoint || before == Content::checkpoint) &&
        !is_same_file(resumed, path) && !is_same_file(resumed, older)) {
        fail("writing the checkpoint '{}': '{}' is that of a render before; go on from it with "
             "--resume '{}', choose another name, or delete it",
             name_of(path), name_of(last == Content::checkpoint ? path : older), name_of(path));
    }
}

void check_checkpoints_replaced(const fs::path& path, const CheckpointKey& key) {
    for (const fs::path& file : {place_of(path), older_checkpoint(path)}) {
        const std::optional<CheckpointKey> found = key_of(file);
        if (found && *found != key) {
            fail("writing the checkpoint '{}': it would replace '{}', which is of another render; "
                 "choose another name, or delete that",
                 name_of(path), name_of(file));
        }
    }
}

void save_checkpoint(const fs::path& path, CheckpointKey key, std::vector<std::uint8_t> state) {
    Archive archive;
    Header header;
    archive.value(header);
    persist_key(archive, key);
    archive.values(state);
    std::vector<std::uint8_t> bytes = std::move(archive).take_bytes();
    const auto contents = std::as_bytes(std::span(bytes)).subspan(sizeof(header));
    header.length = contents.size();
    header.checksum = fingerprint(contents);
    std::memcpy(bytes.data(), &header, sizeof(header));
    // The last checkpoint gives way only once the new one is on disk. A damaged one must not take
    // the place of the one before it.
    Replacement file(path);
    file.write(bytes);
    const fs::path place = place_of(path);
    std::error_code problem;
    if (content_of(place) == Content::checkpoint) {
        fs::rename(place, older_checkpoint(path), problem);
    }
    if (problem) {
        fail("writing the checkpoint '{}': {}; check the folder's permissions", name_of(path),
             problem.message());
    }
    file.put_in_place();
}

LoadedCheckpoint load_checkpoint(const fs::path& path, const CheckpointKey& key) {
    std::vector<std::uint8_t> contents;
    try {
        contents = read_contents(path);
    } catch (const Error& damaged) {
        const fs::path older = older_checkpoint(path);
        if (content_of(older) != Content::checkpoint) {
            fail("{}; choose another file, or render from the start", damaged.what());
        }
        return {.state = state_of(older, read_contents(older), key),
                .note = fmt::format("{}; going on from the checkpoint before it, '{}'",
                                    damaged.what(), name_of(older))};
    }
    return {.state = state_of(path, contents, key), .note = {}};
}

} // namespace argand
