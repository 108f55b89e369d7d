#include "methods/lens.hpp"

#include "accel/closest_hits.hpp"
#include "shared/geometry_records.h"

#include <algorithm>
#include <limits>

namespace argand {

namespace {

// As of --focus. A camera may lie on a surface.
constexpr double least_focus = 1e-9;

} // namespace

double middle_distance(Device& device, const DeviceScene& scene, const CameraRecord& camera,
                       int width, int height) {
    vec3 origin, direction;
    pinhole_ray(camera, 0.5f * static_cast<float>(width), 0.5f * static_cast<float>(height), origin,
                direction);
    const RayRecord ray{.origin_x = origin.x,
                        .origin_y = origin.y,
                        .origin_z = origin.z,
                        .t_max = far_away,
                        .direction_x = direction.x,
                        .direction_y = direction.y,
                        .direction_z = direction.z};
    const HitRecord hit =
        closest_hits(device, scene.bvh, make_traversal(device, 1), std::span(&ray, 1))[0];
    return hit.triangle == no_triangle ? std::numeric_limits<double>::infinity() : hit.t;
}

void copy_lens(const CameraRecord& from, CameraRecord& to) {
    to.lens_radius = from.lens_radius;
    to.inverse_focus = from.inverse_focus;
}

CameraRecord camera_with_lens(Device& device, const DeviceScene& scene, const Camera& camera,
                              const RenderSettings& settings) {
    CameraRecord record = camera_record(camera, settings.width, settings.height);
    if (settings.aperture > 0) {
        const double focus = settings.focus ? *settings.focus
                                            : middle_distance(device, scene, record, settings.width,
                                                              settings.height);
        record.lens_radius = static_cast<float>(0.5 * settings.aperture);
        record.inverse_focus = static_cast<float>(1 / std::max(focus, least_focus));
    }
    return record;
}

} // namespace argand
