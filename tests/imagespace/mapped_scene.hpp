#pragma once

#include "device_fixture.hpp"
#include "imagespace/cube_maps.hpp"
#include "scene/gltf.hpp"
#include "world/world.hpp"

#include <random>
#include <string>
#include <vector>

namespace argand::testing {

/// A scene of which cube maps are made.
class MappedScene : public DeviceTest {
protected:
    void load(const std::string& name) {
        loaded_ = load_gltf(std::string(ARGAND_SOURCE_DIR "/assets/") + name);
        scene_ = upload_scene(open(), loaded_, make_plan(loaded_, {}));
    }

    CubeMaps cast(const std::vector<glm::vec3>& centers, std::uint32_t size) {
        return make_cube_maps(open(), scene_, centers, size, layers_of(scene_), MapMaking::cast);
    }

    Scene loaded_;
    DeviceScene scene_;
};

inline RayRecord ray_from(glm::vec3 origin, glm::vec3 direction, float t_max = far_away) {
    return {.origin_x = origin.x,
            .origin_y = origin.y,
            .origin_z = origin.z,
            .t_max = t_max,
            .direction_x = direction.x,
            .direction_y = direction.y,
            .direction_z = direction.z,
            .cone = 0};
}

} // namespace argand::testing
