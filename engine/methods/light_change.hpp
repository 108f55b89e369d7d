#pragma once

#include "shared/geometry_records.h"
#include "world/device_scene.hpp"

#include <cstdint>
#include <vector>

namespace argand {

/// How much light changes from one moment to another, in relation to itself, as the change of the
/// light that changes most: the distance by which it moves over `distance`, the angle in radians by
/// which it turns, and the share by which its colour or power changes. Infinity if a light appears
/// or vanishes. distance: a typical one between lights and surfaces.
double light_change(const LightTable& before, const LightTable& now, double distance);

/// The change of each light alone. Requires as many lights as before.
std::vector<double> light_changes(const LightTable& before, const LightTable& now, double distance);

/// What photons have seen of a scene that changes.
struct SeenScene {
    LightTable lights;
    std::vector<MeshPlace> meshes;
    std::uint64_t last_material_change = 0;
};

SeenScene seen_of(const DeviceScene& scene);

/// How much light has changed since.
struct SceneChange {
    /// Of all lights: infinity where materials have changed or the number of lights has.
    double of_all = 0;
    double by_meshes = 0; ///< distance by which meshes moved over the scene's radius, to a quarter
    std::vector<double> of_lights; ///< light_changes(); empty if their number has changed
    std::vector<BoxRecord> moved;  ///< boxes that meshes have left and entered

    /// That of what changes most, but for meshes.
    double most() const;
};

SceneChange scene_change(const SeenScene& seen, const DeviceScene& now);

/// How much faster than 2^-1 per half-life photons of an earlier moment have to lose weight: the
/// half-life, in frames, that balances the lag of their light, which changes by this much in a
/// frame, against the noise of those that are left. window: frames in which all photons are
/// replaced. in_disc: photons that an estimate finds. Infinity if nothing changes.
double balanced_half_life(double change, double window, double in_disc);

} // namespace argand
