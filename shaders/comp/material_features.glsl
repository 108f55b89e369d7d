// A bit MATERIAL_* or LOBE_* for each feature that some material of the scene has
// (engine/plan/plan.hpp).
layout(constant_id = 19) const uint material_features = 65535u;
