#include "scene/gltf_texture.hpp"

#include "base/read_file.hpp"
#include "base/thread_each.hpp"
#include "scene/decode_image.hpp"
#include "scene/gltf_uri.hpp"
#include "scene/gltf_value.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <new>
#include <span>
#include <system_error>
#include <utility>

namespace argand {
namespace {

using nlohmann::json;

// Texture coordinates of a vertex: as many as any exporter writes.
constexpr std::uint64_t most_uv_sets = 8;
// Integers of glTF, such as indices, are below this.
constexpr std::uint64_t any_integer = std::uint64_t{1} << 31;

/// A non-negative integer below `limit`, or `otherwise` if it is absent.
std::uint64_t index_of(const GltfSource& source, const json* object, const char* key,
                       std::uint64_t otherwise, std::uint64_t limit, const std::string& what) {
    const json* value = find_member(object, key);
    if (!value) {
        return otherwise;
    }
    const double number = value->is_number() ? value->get<double>() : -1;
    if (!(number >= 0 && number < double(limit) && number == std::floor(number))) {
        source.fail("the \"{}\" of {} is {}; it must be an integer from 0 to {}", key, what,
                    one_line(value->dump(-1, ' ', true), 40), limit - 1);
    }
    return static_cast<std::uint64_t>(number);
}

glm::dvec2 pair_of(const GltfSource& source, const json* object, const char* key,
                   const glm::dvec2& otherwise, const std::string& what) {
    const json* value = find_member(object, key);
    if (!value) {
        return otherwise;
    }
    if (!value->is_array() || value->size() != 2 || !(*value)[0].is_number() ||
        !(*value)[1].is_number()) {
        source.fail("the \"{}\" of {} is not two numbers", key, what);
    }
    return {(*value)[0].get<double>(), (*value)[1].get<double>()};
}

/// KHR_texture_transform: scale, then rotation counter-clockwise as seen with v downwards, then
/// offset.
glm::mat3x2 transform_of(const GltfSource& source, const json* extension, const std::string& what) {
    const glm::dvec2 offset = pair_of(source, extension, "offset", glm::dvec2(0), what);
    const glm::dvec2 scale = pair_of(source, extension, "scale", glm::dvec2(1), what);
    const double rotation = number_of(source, extension, "rotation", 0, what);
    const double c = std::cos(rotation);
    const double s = std::sin(rotation);
    const glm::mat3x2 transform(glm::vec2(scale.x * glm::dvec2(c, -s)),
                                glm::vec2(scale.y * glm::dvec2(s, c)), glm::vec2(offset));
    for (int column = 0; column < 3; ++column) {
        if (!std::isfinite(transform[column].x) || !std::isfinite(transform[column].y)) {
            source.fail("{} has a texture transform that is not finite", what);
        }
    }
    return transform;
}

Wrap wrap_of(const GltfSource& source, const json* sampler, const char* key,
             const std::string& what) {
    constexpr std::uint64_t repeat = 10497, mirrored_repeat = 33648, clamp_to_edge = 33071;
    switch (index_of(source, sampler, key, repeat, any_integer, what)) {
    case repeat:
        return Wrap::repeat;
    case mirrored_repeat:
        return Wrap::mirrored_repeat;
    case clamp_to_edge:
        return Wrap::clamp_to_edge;
    default:
        source.fail("{} has a sampler whose \"{}\" is none of 10497, 33648 and 33071", what, key);
    }
}

bool is_nearest(const GltfSource& source, const json* sampler, const std::string& what) {
    constexpr std::uint64_t nearest = 9728;
    return index_of(source, sampler, "magFilter", 0, any_integer, what) == nearest;
}

/// Mip maps are the default; two filters do without them.
bool has_mip_filter(const GltfSource& source, const json* sampler, const std::string& what) {
    constexpr std::uint64_t nearest = 9728, linear = 9729;
    const std::uint64_t filter = index_of(source, sampler, "minFilter", 0, any_integer, what);
    return filter != nearest && filter != linear;
}

/// Empty if there is none and grey takes its place.
std::vector<std::uint8_t> bytes_of(const GltfSource& source, std::size_t index,
                                   const std::string& what) {
    const tinygltf::Image& image = source.model.images[index];
    if (image.bufferView >= 0) {
        const auto& views = source.model.bufferViews;
        if (std::size_t(image.bufferView) >= views.size()) {
            source.fail("{} refers to buffer view {}, which does not exist", what,
                        image.bufferView);
        }
        const tinygltf::BufferView& view = views[std::size_t(image.bufferView)];
        const auto& buffers = source.model.buffers;
        if (view.buffer < 0 || std::size_t(view.buffer) >= buffers.size() ||
            view.byteOffset > buffers[std::size_t(view.buffer)].data.size() ||
            view.byteLength > buffers[std::size_t(view.buffer)].data.size() - view.byteOffset) {
            source.fail("{} exceeds its buffer", what);
        }
        const auto bytes = std::span(buffers[std::size_t(view.buffer)].data)
                               .subspan(view.byteOffset, view.byteLength);
        return {bytes.begin(), bytes.end()};
    }
    const std::string uri = [&] {
        const json* stated = find_member(find_element(source, "images", index), "uri");
        return stated && stated->is_string() ? stated->get<std::string>() : std::string();
    }();
    if (uri.empty()) {
        source.fail("{} has neither a uri nor a buffer view", what);
    }
    std::vector<std::uint8_t> bytes;
    std::string type;
    if (uri.starts_with("data:")) {
        if (!tinygltf::IsDataURI(uri) || !tinygltf::DecodeDataURI(&bytes, type, uri, 0, false)) {
            source.fail("{} has a data URI that is not base64 of a PNG or JPEG", what);
        }
        return bytes;
    }
    const std::filesystem::path path =
        path_of_uri(source.directory, uri, what, source.options.allow_external);
    std::error_code unknown;
    if (std::filesystem::exists(path, unknown) || unknown) {
        return read_file(path);
    }
    if (!source.options.grey_for_missing) {
        fail("{} is at '{}', which does not exist; --missing-textures grey renders without it",
             what, one_line(uri, 60));
    }
    return {};
}

/// In the place of an image that does not exist: a texel of half the light, or a flat normal.
TextureImage grey_image(const std::string& name, bool of_normals) {
    const glm::u8vec4 texel =
        of_normals ? glm::u8vec4(128, 128, 255, 255) : glm::u8vec4(glm::u8vec3(188), 255);
    return {.name = name,
            .width = 1,
            .height = 1,
            .texels = {std::bit_cast<std::uint32_t>(texel)},
            .low = texel,
            .high = texel};
}

} // namespace

std::uint32_t TextureReader::image_of(std::size_t in_file) {
    const auto known = std::find(images_.begin(), images_.end(), in_file);
    if (known == images_.end()) {
        images_.push_back(in_file);
        return static_cast<std::uint32_t>(images_.size() - 1);
    }
    return static_cast<std::uint32_t>(known - images_.begin());
}

std::optional<Texture> TextureReader::read(const json* owner, const char* key,
                                           const std::string& what, std::size_t& image) {
    const json* info = find_member(owner, key);
    if (!info) {
        return {};
    }
    const std::string name = what + "'s " + key;
    if (!info->is_object() || !info->contains("index")) {
        source_.fail("{} is not an object with the index of a texture", name);
    }
    const std::size_t count = source_.model.textures.size();
    const std::uint64_t number = index_of(source_, info, "index", 0, any_integer, name);
    if (number >= count) {
        source_.fail("{} is texture {}, which does not exist", name, number);
    }
    const json* from = find_element(source_, "textures", number);
    if (!find_member(from, "source")) {
        add_note(scene_, fmt::format("{} has no PNG or JPEG and is ignored", name));
        return {};
    }
    image = index_of(source_, from, "source", 0, any_integer, name);
    if (image >= source_.model.images.size()) {
        source_.fail("{} uses image {}, which does not exist", name, image);
    }
    const json* sampler_index = find_member(from, "sampler");
    const json* sampler =
        sampler_index ? find_element(source_, "samplers",
                                     index_of(source_, from, "sampler", 0, any_integer, name))
                      : nullptr;
    if (sampler_index && !sampler) {
        source_.fail("{} uses a sampler that does not exist", name);
    }
    const json* transform = find_member(find_member(info, "extensions"), "KHR_texture_transform");
    if (transform && !transform->is_object()) {
        source_.fail("the KHR_texture_transform of {} is not an object", name);
    }
    Texture texture;
    const std::uint64_t set = index_of(source_, info, "texCoord", 0, most_uv_sets, name);
    texture.uv_set = static_cast<std::uint32_t>(
        index_of(source_, transform, "texCoord", set, most_uv_sets, name));
    texture.wrap_u = wrap_of(source_, sampler, "wrapS", name);
    texture.wrap_v = wrap_of(source_, sampler, "wrapT", name);
    texture.nearest = is_nearest(source_, sampler, name);
    texture.mips = !texture.nearest && has_mip_filter(source_, sampler, name);
    texture.transform = transform_of(source_, transform, name);
    return texture;
}

bool TextureReader::add(const json* owner, const char* key, TextureUse use, const std::string& what,
                        float scale) {
    std::size_t image = 0;
    std::optional<Texture> texture = read(owner, key, what, image);
    if (!texture) {
        return false;
    }
    texture->image = image_of(image);
    texture->use = use;
    texture->scale = scale;
    texture->srgb = use == TextureUse::base_color || use == TextureUse::emissive ||
                    use == TextureUse::specular_color || use == TextureUse::sheen_color;
    scene_.textures.push_back(*texture);
    scene_.uv_sets = std::max(scene_.uv_sets, texture->uv_set + 1);
    return true;
}

void TextureReader::check(const json* owner, const char* key, const std::string& what) {
    std::size_t image = 0;
    read(owner, key, what, image);
}

void TextureReader::decode_images() {
    scene_.images.resize(images_.size());
    std::vector<std::string> problems(images_.size());
    std::vector<std::uint8_t> missing(images_.size(), 0);
    const auto is_of_normals = [&](std::size_t image) {
        return std::any_of(scene_.textures.begin(), scene_.textures.end(), [&](const Texture& t) {
            return t.image == image &&
                   (t.use == TextureUse::normal || t.use == TextureUse::coat_normal);
        });
    };
    std::atomic<std::uint64_t> texels = 0;
    for_each_on_all_cores(images_.size(), [&](std::size_t i) {
        const std::string what =
            label("image", static_cast<int>(images_[i]), source_.model.images[images_[i]].name);
        try {
            const std::vector<std::uint8_t> bytes = bytes_of(source_, images_[i], what);
            missing[i] = bytes.empty() && source_.options.grey_for_missing;
            TextureImage image =
                missing[i] ? grey_image(what, is_of_normals(i)) : decode_image(bytes, what);
            if ((texels += image.texels.size()) > most_texels_of_scene) {
                fail("all textures together have more than {} million pixels; make them smaller",
                     most_texels_of_scene >> 20);
            }
            scene_.images[i] = std::make_shared<const TextureImage>(std::move(image));
        } catch (const Error& problem) {
            problems[i] = problem.what();
            if (!problems[i].starts_with("cannot")) {
                const std::string named = problems[i].starts_with(what) ? "" : what + ": ";
                problems[i] =
                    fmt::format("cannot load '{}': {}{}", source_.file, named, problems[i]);
            }
        } catch (const std::bad_alloc&) {
            problems[i] = fmt::format("cannot load '{}': there is not enough memory for {}",
                                      source_.file, what);
        }
    });
    for (const std::string& problem : problems) {
        if (!problem.empty()) {
            fail("{}", problem);
        }
    }
    const auto count = std::count(missing.begin(), missing.end(), 1);
    if (count > 0) {
        add_note(scene_, fmt::format("{} image{} not exist: grey is in {} place", count,
                                     count == 1 ? " does" : "s do", count == 1 ? "its" : "their"));
    }
}

} // namespace argand
