#pragma once

#include "scene/scene.hpp"
#include "shared/material_record.h"

namespace argand {

/// A material as the kernels see it, which decides its lobes (shared/bsdf.h).
MaterialRecord material_record(const Material& material);

} // namespace argand
