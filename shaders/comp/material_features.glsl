// A bit MATERIAL_* or LOBE_* for each feature that some material of the scene has
// (engine/plan/plan.hpp).
#if !defined(ARGAND_LEAN) && !defined(ARGAND_PLAIN)
layout(constant_id = 19) const uint material_features = 524287u;
#elif defined(ARGAND_LEAN) // for scenes that have none but MATERIAL_LEAN
layout(constant_id = 19) const uint material_features = 4047u;
#else // none but MATERIAL_PLAIN
layout(constant_id = 19) const uint material_features = 655u;
#endif
