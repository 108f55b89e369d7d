#pragma once

#include "methods/render_settings.hpp"
#include "shared/camera.h"
#include "world/device_scene.hpp"

namespace argand {

/// The distance along the camera's axis of what is in the middle of a width x height picture, as
/// seen through a pinhole; infinity if nothing is there. Waits for the device.
double middle_distance(Device& device, const DeviceScene& scene, const CameraRecord& camera,
                       int width, int height);

/// Gives a camera the lens of another one.
void copy_lens(const CameraRecord& from, CameraRecord& to);

/// The camera of a picture with these settings, lens included. Waits for the device if the lens
/// focuses on what is in the middle.
CameraRecord camera_with_lens(Device& device, const DeviceScene& scene, const Camera& camera,
                              const RenderSettings& settings);

} // namespace argand
