// MATERIAL_* and LOBE_* that materials of the scene have (engine/plan/plan.hpp).
layout(constant_id = 19) const uint material_features = 255u;
