#pragma once

#include "scene/scene.hpp"
#include "shared/material_record.h"

namespace argand {

/// The material as a record for kernels. The record determines the material's lobes
/// (shared/bsdf.h).
MaterialRecord material_record(const Material& material);

} // namespace argand
