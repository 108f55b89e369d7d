#pragma once

#include "scene/scene.hpp"
#include "shared/photon_records.h"

#include <limits>
#include <vector>

namespace argand {

/// A part of the scene in which areas are sampled.
struct SampledPart {
    glm::vec3 center{0};
    double reach = std::numeric_limits<double>::infinity(); ///< distance from there
};

/// The surfaces on which area samples lie, along a space-filling curve so that equal steps of area
/// are evenly spread over them whatever the order of the file.
struct AreaTable {
    std::vector<AreaSumRecord> sums;
    double area = 0; ///< of all pieces
};

/// Area of each triangle on which photons may lie: 0 for mirrors, glass and what is black, and 0
/// for duplicates with the same front, of which rays hit only the first.
std::vector<double> areas_for_photons(const PlacedScene& placed, float follow_roughness);

/// The table of the surfaces on which photons may lie, whose areas are given by triangle. It
/// contains all of them that lie within the sampled part, and little else: large triangles are
/// divided into pieces for that.
AreaTable make_area_table(const PlacedScene& placed, const std::vector<double>& areas,
                          const SampledPart& part);

} // namespace argand
