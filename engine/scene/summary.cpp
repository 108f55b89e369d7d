#include "scene/summary.hpp"

#include "base/text.hpp"
#include "scene/environment_summary.hpp"
#include "scene/gltf_extensions.hpp"
#include "scene/light_power.hpp"
#include "scene/objects.hpp"
#include "scene/solids.hpp"
#include "shared/texture_record.h"
#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <iterator>
#include <numbers>
#include <utility>

namespace argand {
namespace {

using json = nlohmann::ordered_json;

template <class Vector> json numbers(const Vector& v) {
    return json::array({v.x + 0, v.y + 0, v.z + 0}); // −0 + 0 is 0
}

double degrees(double radians) { return radians * 180 / std::numbers::pi; }

json material_json(const Material& material, std::size_t triangles, double area) {
    return {{"name", material.name},
            {"kind", describe(material)},
            {"triangles", triangles},
            {"area", area},
            {"base_color", numbers(material.base_color)},
            {"metallic", material.metallic},
            {"roughness", material.roughness},
            {"specular", material.specular},
            {"specular_color", numbers(material.specular_color)},
            {"transmission", material.transmission},
            {"ior", material.ior},
            {"thickness", material.thickness},
            {"absorption", numbers(material.absorption)},
            {"coat", material.coat},
            {"coat_roughness", material.coat_roughness},
            {"coat_has_normal", material.coat_has_normal},
            {"dispersion", material.dispersion},
            {"priority", material.priority},
            {"sheen_color", numbers(material.sheen_color)},
            {"sheen_roughness", material.sheen_roughness},
            {"anisotropy", glm::length(material.anisotropy)},
            {"iridescence", material.film},
            {"film_ior", material.film_ior},
            {"film_thickness", material.film_thickness},
            {"alpha", material.coverage},
            {"alpha_varies", material.alpha_varies},
            {"cut_out", material.alpha_varies && material.alpha_mode == AlphaMode::mask},
            {"phong", material.phong ? json{{"specular", numbers(material.phong->specular)},
                                            {"exponent", material.phong->exponent}}
                                     : json(nullptr)},
            {"emission", numbers(material.emission)},
            {"double_sided", material.double_sided}};
}

const char* name_of(TextureUse use) {
    switch (use) { // without a default, so that the compiler finds a use that is missing
    case TextureUse::base_color:
        break;
    case TextureUse::metallic_roughness:
        return "metallic_roughness";
    case TextureUse::emissive:
        return "emissive";
    case TextureUse::normal:
        return "normal";
    case TextureUse::specular:
        return "specular";
    case TextureUse::specular_color:
        return "specular_color";
    case TextureUse::transmission:
        return "transmission";
    case TextureUse::thickness:
        return "thickness";
    case TextureUse::coat:
        return "coat";
    case TextureUse::coat_roughness:
        return "coat_roughness";
    case TextureUse::coat_normal:
        return "coat_normal";
    case TextureUse::sheen_color:
        return "sheen_color";
    case TextureUse::sheen_roughness:
        return "sheen_roughness";
    case TextureUse::film:
        return "film";
    case TextureUse::film_thickness:
        return "film_thickness";
    case TextureUse::anisotropy:
        return "anisotropy";
    }
    return "base_color";
}

json textures_json(const Scene& scene, const Material& material) {
    json list = json::array();
    for (std::uint32_t i = 0; i < material.texture_count; ++i) {
        const Texture& texture = scene.textures[material.first_texture + i];
        const TextureImage& image = *scene.images[texture.image];
        list.push_back(
            {{"kind", name_of(texture.use)}, {"width", image.width}, {"height", image.height}});
    }
    return list;
}

json materials_json(const Scene& scene) {
    std::vector<std::size_t> triangles(scene.materials.size(), 0);
    std::vector<double> areas(scene.materials.size(), 0);
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
        ++triangles[scene.triangle_material[i]];
        areas[scene.triangle_material[i]] += area(scene, i);
    }
    json list = json::array();
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        list.push_back(material_json(scene.materials[i], triangles[i], areas[i]));
        list.back()["textures"] = textures_json(scene, scene.materials[i]);
    }
    return list;
}

json light_json(const Light& light) {
    json object{{"name", light.name}, {"intensity", numbers(light.intensity)}};
    switch (light.kind) {
    case LightKind::point:
        object["kind"] = "point";
        break;
    case LightKind::spot:
        object["kind"] = "spot";
        break;
    case LightKind::directional:
        object["kind"] = "directional";
        break;
    }
    object["unit"] = light.kind == LightKind::directional ? "lux" : "candela";
    if (light.kind != LightKind::directional) {
        object["position"] = numbers(light.position);
        object["power"] = numbers(emitted_power(light));
    }
    if (light.kind != LightKind::point) {
        object["direction"] = numbers(light.direction);
    }
    if (light.kind == LightKind::spot) {
        object["inner_cone_angle"] = light.inner_cone_angle;
        object["outer_cone_angle"] = light.outer_cone_angle;
    }
    return object;
}

json emissive_json(const Scene& scene) {
    std::size_t triangles = 0, textured = 0;
    double lit_area = 0;
    glm::dvec3 power(0);
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
        const Material& material = scene.materials[scene.triangle_material[i]];
        if (emits(material)) {
            ++triangles;
            const bool by_texels = (material.texture_bits & material_emissive_texture) != 0;
            const bool has_holes = material.alpha_varies && material.alpha_mode == AlphaMode::mask;
            textured += by_texels || has_holes ? 1 : 0;
            lit_area += area(scene, i);
            power += emitted_power(scene, i);
        }
    }
    return {{"triangles", triangles},
            {"textured", textured},
            {"area", lit_area},
            {"power", numbers(power)}};
}

json camera_json(const Camera& camera) {
    json object{{"name", camera.name},
                {"position", numbers(camera.position)},
                {"forward", numbers(camera.forward)},
                {"up", numbers(camera.up)},
                {"aspect", camera.aspect > 0 ? json(camera.aspect) : json(nullptr)}};
    if (camera.kind == CameraKind::perspective) {
        object["kind"] = "perspective";
        object["vertical_angle"] = camera.vertical_angle;
    } else {
        object["kind"] = "orthographic";
        object["vertical_extent"] = camera.vertical_extent;
    }
    return object;
}

/// "1 0.5 0", or "1" where all three are equal.
std::string short_text(const json& vector) {
    const double x = vector[0];
    const double y = vector[1];
    const double z = vector[2];
    return x == y && y == z ? fmt::format("{:.4g}", x)
                            : fmt::format("{:.4g} {:.4g} {:.4g}", x, y, z);
}

std::string full_text(const json& vector) {
    return fmt::format("{:.4g} {:.4g} {:.4g}", vector[0].get<double>(), vector[1].get<double>(),
                       vector[2].get<double>());
}

std::string quoted_name(const json& object) {
    const auto name = object["name"].get<std::string>();
    return name.empty() ? "(no name)" : name;
}

/// What lies over metal and dielectric, how a solid disperses, and its priority.
std::string layers_text(const json& material) {
    const auto value = [&](const char* key) { return material[key].get<double>(); };
    std::string text;
    if (value("dispersion") > 0 && value("transmission") > 0 && value("thickness") > 0) {
        text += fmt::format(", dispersion {:.4g}", value("dispersion"));
    }
    if (value("priority") != 0 && value("thickness") > 0) {
        text += fmt::format(", priority {:.4g}", value("priority"));
    }
    if (value("anisotropy") > 0) {
        text += fmt::format(", anisotropy {:.4g}", value("anisotropy"));
    }
    if (value("iridescence") > 0) {
        text += fmt::format(", film {:.4g} of {:.4g} nm with index {:.4g}", value("iridescence"),
                            1000 * value("film_thickness"), value("film_ior"));
    }
    if (material["sheen_color"] != json::array({0.0f, 0.0f, 0.0f})) {
        text += fmt::format(", sheen {} of roughness {:.4g}", short_text(material["sheen_color"]),
                            value("sheen_roughness"));
    }
    if (value("coat") > 0) {
        text += fmt::format(", coat {:.4g} of roughness {:.4g}{}", value("coat"),
                            value("coat_roughness"),
                            material["coat_has_normal"].get<bool>() ? " with its own normal" : "");
    }
    return text;
}

std::string material_line(const json& material) {
    std::string line =
        fmt::format("{}: {}, base colour {}", quoted_name(material),
                    material["kind"].get<std::string>(), short_text(material["base_color"]));
    const json& phong = material["phong"];
    if (phong.is_null()) {
        line +=
            fmt::format(", metallic {:.4g}, roughness {:.4g}", material["metallic"].get<double>(),
                        material["roughness"].get<double>());
    } else {
        line += fmt::format(", specular colour {}, exponent {:.4g}", short_text(phong["specular"]),
                            phong["exponent"].get<double>());
    }
    if (phong.is_null() && material["transmission"].get<double>() > 0) {
        line += fmt::format(", transmission {:.4g}, index of refraction {:.4g}",
                            material["transmission"].get<double>(), material["ior"].get<double>());
        if (material["thickness"].get<double>() > 0 &&
            material["absorption"] != json::array({0.0f, 0.0f, 0.0f})) {
            line += fmt::format(", absorption {} per metre", short_text(material["absorption"]));
        }
    }
    if (phong.is_null()) {
        line += layers_text(material);
    }
    if (material["alpha"].get<double>() < 1) {
        line += fmt::format(", alpha {:.4g}", material["alpha"].get<double>());
    }
    if (material["alpha_varies"].get<bool>()) {
        line += material["cut_out"].get<bool>() ? ", cut out by alpha" : ", alpha varies";
    }
    if (material["emission"] != json::array({0.0f, 0.0f, 0.0f})) {
        line += fmt::format(", emits {} cd/m2{}", short_text(material["emission"]),
                            material["double_sided"].get<bool>() ? " from both sides" : "");
    }
    for (const json& texture : material["textures"]) {
        line += fmt::format(", {} of {} x {} texels", texture["kind"].get<std::string>(),
                            texture["width"].get<std::uint32_t>(),
                            texture["height"].get<std::uint32_t>());
    }
    return line + fmt::format(" ({} triangles, area {:.4g})",
                              material["triangles"].get<std::size_t>(),
                              material["area"].get<double>());
}

std::string light_line(const json& light) {
    std::string line =
        fmt::format("{}: {}, {} {}", quoted_name(light), light["kind"].get<std::string>(),
                    short_text(light["intensity"]), light["unit"].get<std::string>());
    if (light.contains("power")) {
        line += fmt::format(", power {}, at {}", short_text(light["power"]),
                            full_text(light["position"]));
    }
    if (light.contains("direction")) {
        line += fmt::format(", along {}", full_text(light["direction"]));
    }
    if (light.contains("inner_cone_angle")) {
        line += fmt::format(", cone {:.4g} to {:.4g} degrees",
                            degrees(light["inner_cone_angle"].get<double>()),
                            degrees(light["outer_cone_angle"].get<double>()));
    }
    return line;
}

std::string camera_line(const json& camera) {
    std::string line =
        fmt::format("{}: {}, ", quoted_name(camera), camera["kind"].get<std::string>());
    if (camera.contains("vertical_angle")) {
        line += fmt::format("{:.4g} degrees high", degrees(camera["vertical_angle"].get<double>()));
    } else {
        line += fmt::format("{:.4g} high", 2 * camera["vertical_extent"].get<double>());
    }
    if (!camera["aspect"].is_null()) {
        line += fmt::format(", width to height {:.4g}", camera["aspect"].get<double>());
    }
    return line + fmt::format(", at {}, looking along {}", full_text(camera["position"]),
                              full_text(camera["forward"]));
}

std::string animation_line(const json& animation) {
    constexpr std::size_t most_listed = 8;
    auto moves = animation["moves"].get<std::vector<std::string>>();
    const std::size_t count = moves.size();
    moves.resize(std::min(count, most_listed));
    return fmt::format(
        "{}: {:.4g} s, moves {}{}", quoted_name(animation), animation["seconds"].get<double>(),
        moves.empty() ? "nothing" : fmt::format("{}", fmt::join(moves, ", ")),
        count > most_listed ? fmt::format(", and {} more", count - most_listed) : "");
}

json motion_json(const Scene& scene) {
    const Motion& motion = scene.motion;
    std::size_t vertices = 0, emissive = 0;
    for (const MovingMesh& mesh : motion.meshes) {
        vertices += mesh.positions.size();
        const auto first =
            scene.triangle_material.begin() + static_cast<std::ptrdiff_t>(mesh.first_triangle);
        emissive += static_cast<std::size_t>(
            std::count_if(first, first + static_cast<std::ptrdiff_t>(mesh.triangles),
                          [&](std::uint32_t m) { return emits(scene.materials[m]); }));
    }
    return {{"vertices", vertices},
            {"emissive_triangles", emissive},
            {"skins", motion.skins.size()},
            {"lights", motion.lights.size()},
            {"cameras", motion.cameras.size()},
            {"materials", motion.materials.size()}};
}

std::string motion_line(const json& motion) {
    return fmt::format(
        "{} vertices, {} emissive triangles, {} skins, {} punctual lights, {} "
        "cameras, {} materials",
        motion["vertices"].get<std::size_t>(), motion["emissive_triangles"].get<std::size_t>(),
        motion["skins"].get<std::size_t>(), motion["lights"].get<std::size_t>(),
        motion["cameras"].get<std::size_t>(), motion["materials"].get<std::size_t>());
}

/// The objects that edits can name (scene/edits.hpp).
json objects_json(const Scene& scene) {
    json objects = json::array();
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        const SceneObject& object = scene.objects[i];
        objects.push_back({{"node", object.node},
                           {"name", one_line(object.name)},
                           {"triangles", end_of_object(scene, i) - object.first_triangle}});
    }
    return objects;
}

std::string objects_text(const json& objects) {
    constexpr std::size_t most_listed = 12;
    std::vector<std::string> names;
    for (std::size_t i = 0; i < std::min(objects.size(), most_listed); ++i) {
        const std::string name = quoted_name(objects[i]);
        names.push_back(objects[i]["name"].get<std::string>().empty()
                            ? fmt::format("node {}", objects[i]["node"].get<std::uint32_t>())
                            : name);
    }
    return objects.empty() ? "0"
                           : fmt::format("{}: {}{}", objects.size(), fmt::join(names, ", "),
                                         objects.size() > most_listed ? ", ..." : "");
}

template <class Line>
void append_list(std::string& text, const char* title, const json& list, Line line) {
    fmt::format_to(std::back_inserter(text), "{:<12}{}\n", title, list.size());
    for (std::size_t i = 0; i < list.size(); ++i) {
        fmt::format_to(std::back_inserter(text), "  {:>3}  {}\n", i, line(list[i]));
    }
}

} // namespace

std::string describe(const Material& material) {
    if (material.unlit) {
        return "unlit";
    }
    if (material.phong) {
        return "Phong";
    }
    // KHR_materials_transmission applies to the dielectric part: metal does not transmit.
    if (material.metallic >= 1) {
        const bool smooth = material.roughness <= 0 && material.anisotropy == glm::vec2(0);
        return smooth ? "mirror" : "metal";
    }
    if (material.transmission > 0) {
        const char* solid = material.thickness > 0 ? "glass" : "thin glass";
        return material.transmission < 1 ? fmt::format("part {}", solid) : solid;
    }
    if (material.metallic > 0) {
        return "part metal";
    }
    return material.specular <= 0 ? "Lambertian" : "dielectric";
}

json summary_json(const Scene& scene) {
    const Bounds box = bounds(scene);
    json lights = json::array();
    std::transform(scene.lights.begin(), scene.lights.end(), std::back_inserter(lights),
                   light_json);
    json cameras = json::array();
    std::transform(scene.cameras.begin(), scene.cameras.end(), std::back_inserter(cameras),
                   camera_json);
    json animations = json::array();
    for (const Animation& animation : scene.animations) {
        animations.push_back(
            {{"name", animation.name}, {"seconds", animation.seconds}, {"moves", animation.moves}});
    }
    json solids = json::array();
    for (const std::uint32_t material : known_solid_ranks(scene).materials) {
        solids.push_back({{"material", material}, {"name", scene.materials[material].name}});
    }
    json extensions = json::array();
    for (const std::string& name : scene.extensions_used) {
        extensions.push_back({{"name", name}, {"understood", supports_extension(name)}});
    }
    return {{"name", scene.name},
            {"triangles", scene.triangles.size()},
            {"vertices", scene.positions.size()},
            {"area", surface_area(scene)},
            {"bounds", {{"low", numbers(box.low)}, {"high", numbers(box.high)}}},
            {"objects", objects_json(scene)},
            {"materials", materials_json(scene)},
            {"solids", solids},
            {"lights", lights},
            {"emissive", emissive_json(scene)},
            {"sky", scene.sky ? numbers(*scene.sky) : json(nullptr)},
            {"environment", environment_json(scene)},
            {"cameras", cameras},
            {"animations", animations},
            {"moving", motion_json(scene)},
            {"extensions", extensions},
            {"notes", scene.notes}};
}

std::string summary_text(const Scene& scene) {
    const json summary = summary_json(scene);
    std::string text = fmt::format("{}\n", scene.name);
    const auto line = [&](const char* title, const std::string& value) {
        fmt::format_to(std::back_inserter(text), "{:<12}{}\n", title, value);
    };
    line("triangles",
         fmt::format("{} over {} vertices", scene.triangles.size(), scene.positions.size()));
    line("area", fmt::format("{:.4g}", summary["area"].get<double>()));
    line("bounds", fmt::format("{} to {}", full_text(summary["bounds"]["low"]),
                               full_text(summary["bounds"]["high"])));
    line("objects", objects_text(summary["objects"]));
    append_list(text, "materials", summary["materials"], material_line);
    if (summary["solids"].size() > 1) {
        std::vector<std::string> names;
        for (const json& solid : summary["solids"]) {
            names.push_back(quoted_name(solid));
        }
        line("solids", fmt::format("{}: where they overlap, the last of them is there",
                                   fmt::join(names, ", ")));
    }
    append_list(text, "lights", summary["lights"], light_line);
    const json& emissive = summary["emissive"];
    const auto textured = emissive["textured"].get<std::size_t>();
    line("emissive",
         fmt::format("{} triangles, area {:.4g}, power {}{}",
                     emissive["triangles"].get<std::size_t>(), emissive["area"].get<double>(),
                     short_text(emissive["power"]),
                     textured > 0 ? fmt::format(" before the textures of {}", textured) : ""));
    line("sky", summary["sky"].is_null()
                    ? environment_text(scene)
                    : fmt::format("uniform, radiance {}", short_text(summary["sky"])));
    append_list(text, "cameras", summary["cameras"], camera_line);
    append_list(text, "animations", summary["animations"], animation_line);
    if (!scene.animations.empty()) {
        line("moving", motion_line(summary["moving"]));
    }
    append_list(text, "extensions", summary["extensions"], [](const json& extension) {
        return extension["name"].get<std::string>() +
               (extension["understood"].get<bool>() ? "" : " (not supported)");
    });
    append_list(text, "notes", summary["notes"],
                [](const json& note) { return note.get<std::string>(); });
    return text;
}

} // namespace argand
