#include "methods/near_field.hpp"

#include "methods/view_extent.hpp"

namespace argand {

namespace {

// Over the extent of what is in view: a centimetre in a room of some metres.
constexpr double near_share = 1.0 / 256;
// Share of the photons from nearby surfaces. With fewer the rays cost more than they bring.
constexpr double least_photons = 0.03;

} // namespace

void begin_near_field(RenderContext& context, std::span<const glm::vec4> points, bool usable) {
    double distance = 0;
    if (usable && context.settings.near_field) {
        distance = *context.settings.near_field;
    } else if (usable && !points.empty()) {
        distance = near_share * view_extent(points).distance;
    }
    const bool follows = distance > 0 && context.settings.near_field.has_value();
    set_near_field(context.device, context.on_device, static_cast<float>(distance), follows);
}

bool learn_near_field(RenderContext& context, const StoredPhotons& stored) {
    const SceneRecord& scene = context.on_device.record;
    const auto near = static_cast<double>(stored.near);
    if (scene.follows_near != 0 || !(near > least_photons * static_cast<double>(stored.photons))) {
        return false;
    }
    set_near_field(context.device, context.on_device, scene.near_distance, true);
    return true;
}

} // namespace argand
