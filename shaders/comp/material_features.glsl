// A bit MATERIAL_* or LOBE_* for each feature that some material of the scene has
// (engine/plan/plan.hpp).
#ifndef ARGAND_LEAN
layout(constant_id = 19) const uint material_features = 262143u;
#else // for scenes that have none but MATERIAL_LEAN
layout(constant_id = 19) const uint material_features = 4047u;
#endif
