#pragma once

#include "image/image.hpp"
#include "methods/render_settings.hpp"
#include "world/world.hpp"

#include <optional>
#include <string_view>
#include <vector>

namespace argand {

/// What else a picture's file can have beside radiance. All but the variance describe what camera
/// rays hit first, which no method changes.
struct FeatureLayers {
    bool albedo = false; ///< base colour with textures, mean over the samples; 0 where nothing is
    bool normal = false; ///< shading normal in world space towards the eye, mean over the samples
    bool depth = false;  ///< along the camera's axis at the pixel's middle; infinite where nothing
                         ///< is
    bool id = false;     ///< object_id() of what is at the pixel's middle; 0 where nothing is
    bool variance = false; ///< of the pixel's mean radiance: RenderSettings::variance

    /// Whether camera rays have to be traced for them.
    bool any_first_hits() const { return albedo || normal || depth || id; }
};

/// Switches on the layer of that name. Returns false if there is none.
bool add_feature(std::string_view name, FeatureLayers& layers);

/// The layers albedo, normal (X, Y, Z), depth (Z) and id (Z), as far as they are wanted, with the
/// size, crop, camera, lens, filter and samples of the settings. At most `most_feature_samples` of
/// these are taken. They show the scene as it is in the world now. Waits for the device.
std::vector<Layer> render_features(World& world, const Scene& scene, const RenderSettings& settings,
                                   const FeatureLayers& wanted);

inline constexpr std::uint32_t most_feature_samples = 64;

} // namespace argand
