#include "scene/edits.hpp"

#include "base/json_members.hpp"
#include "base/text.hpp"
#include "scene/direction.hpp"

#include <fmt/format.h>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

namespace argand {

namespace {

using Json = nlohmann::json;

constexpr double largest_number = std::numeric_limits<float>::max();

/// The members of an object of the edits.
class Members : public JsonMembers {
public:
    using JsonMembers::JsonMembers;

    void read(const char* key, std::optional<double>& value, double low, double high) {
        if (const Json* member = find(key)) {
            if (!member->is_number() || !(member->get<double>() >= low) ||
                !(member->get<double>() <= high)) {
                complain(key, fmt::format("a number from {:.6g} to {:.6g}", low, high));
            }
            value = member->get<double>();
        }
    }

    void read(const char* key, std::optional<glm::dvec3>& value, double low, double high) {
        if (const auto numbers = read_numbers(key, 3, low, high)) {
            value = glm::dvec3((*numbers)[0], (*numbers)[1], (*numbers)[2]);
        }
    }

    void read_unit(const char* key, std::optional<glm::dvec3>& value) {
        read(key, value, -largest_number, largest_number);
        if (value) {
            value = unit_or_zero(*value);
            if (*value == glm::dvec3(0)) {
                complain(key, "a direction, which is not 0");
            }
        }
    }

    /// x, y, z, w, as in glTF.
    void read(const char* key, std::optional<glm::dquat>& value) {
        if (const auto numbers = read_numbers(key, 4, -1e9, 1e9)) {
            const std::vector<double>& n = *numbers;
            const glm::dquat rotation(n[3], n[0], n[1], n[2]);
            if (!(glm::length(rotation) > 0)) {
                complain(key, "a quaternion x, y, z, w, which is not 0");
            }
            value = glm::normalize(rotation);
        }
    }

    /// Calls `add` with the name and the members of each object that is a member of member `key`.
    template <class Add> void for_each(const char* key, const Add& add) {
        if (const Json* objects = find(key)) {
            if (!objects->is_object()) {
                complain(key, "an object of edits by name");
            }
            for (const auto& [name, object] : objects->items()) {
                Members members(object, fmt::format("{} '{}'", key, one_line(name, 60)), doing());
                add(name, members);
                members.end();
            }
        }
    }

    std::optional<Members> object(const char* key) {
        const Json* member = find(key);
        return member ? std::optional(Members(*member, key, doing())) : std::nullopt;
    }

private:
    std::optional<std::vector<double>> read_numbers(const char* key, std::size_t count, double low,
                                                    double high) {
        const Json* member = find(key);
        if (!member) {
            return {};
        }
        std::vector<double> numbers;
        for (const Json& element : member->is_array() ? *member : Json::array()) {
            const double number = element.is_number() ? element.get<double>()
                                                      : std::numeric_limits<double>::quiet_NaN();
            if (number >= low && number <= high) {
                numbers.push_back(number);
            }
        }
        if (numbers.size() != count || member->size() != count) {
            complain(key, fmt::format("{} numbers from {:.6g} to {:.6g}", count, low, high));
        }
        return numbers;
    }
};

NodeEdit read_node(Members& members) {
    NodeEdit edit;
    members.read("translation", edit.translation, -largest_number, largest_number);
    members.read("rotation", edit.rotation);
    members.read("scale", edit.scale, -largest_number, largest_number);
    return edit;
}

LightEdit read_light(Members& members) {
    LightEdit edit;
    members.read("position", edit.position, -largest_number, largest_number);
    members.read_unit("direction", edit.direction);
    members.read("intensity", edit.intensity, 0, largest_number);
    return edit;
}

MaterialEdit read_material(Members& members) {
    MaterialEdit edit;
    members.read("base_color", edit.base_color, 0, 1);
    members.read("emission", edit.emission, 0, largest_number);
    members.read("ior", edit.ior, 1, largest_number);
    for (const auto& [key, value] :
         {std::pair{"metallic", &edit.metallic}, std::pair{"roughness", &edit.roughness},
          std::pair{"specular", &edit.specular}, std::pair{"transmission", &edit.transmission},
          std::pair{"coat", &edit.coat}, std::pair{"coat_roughness", &edit.coat_roughness}}) {
        members.read(key, *value, 0, 1);
    }
    return edit;
}

CameraEdit read_camera(Members& members) {
    CameraEdit edit;
    members.read("position", edit.position, -largest_number, largest_number);
    members.read("target", edit.target, -largest_number, largest_number);
    members.read_unit("up", edit.up);
    members.read("vertical_angle", edit.vertical_angle, 0.01, 179);
    return edit;
}

SunPosition read_sun(Members& members) {
    std::optional<double> elevation, azimuth, turbidity;
    members.read("elevation", elevation, -90, 90);
    members.read("azimuth", azimuth, -1e6, 1e6);
    members.read("turbidity", turbidity, 1, 10);
    members.end();
    const SunPosition usual;
    return {.elevation = elevation.value_or(usual.elevation),
            .azimuth = azimuth.value_or(usual.azimuth),
            .turbidity = turbidity.value_or(usual.turbidity)};
}

} // namespace

Edits parse_edits(const nlohmann::json& json, const std::string& source) {
    Edits edits;
    Members all(json, "the text", fmt::format("reading edits '{}'", source));
    edits.has_nodes = json.contains("nodes");
    all.for_each("nodes", [&](const std::string& name, Members& members) {
        edits.nodes[name] = read_node(members);
    });
    all.for_each("lights", [&](const std::string& name, Members& members) {
        edits.lights[name] = read_light(members);
    });
    all.for_each("materials", [&](const std::string& name, Members& members) {
        edits.materials[name] = read_material(members);
    });
    all.for_each("cameras", [&](const std::string& name, Members& members) {
        edits.cameras[name] = read_camera(members);
    });
    if (std::optional<Members> sun = all.object("sun")) {
        edits.sun = read_sun(*sun);
    }
    all.end();
    return edits;
}

} // namespace argand
