// A plan with everything is every lobe and every kind of light: a new one that the plan or the
// kernels' defaults forget fails here (docs/adding.md).
#include "plan/plan.hpp"

#include "shared/bsdf.h"
#include "shared/light_record.h"
#include "support/scratch_directory.hpp"

#include <gtest/gtest.h>
#include <regex>
#include <string>
#include <vector>

namespace argand::testing {
namespace {

/// The defaults that a file of shaders/comp declares for a specialization constant, each for one
/// module.
std::vector<std::uint32_t> defaults_of(const std::string& file, const std::string& constant) {
    const std::string text =
        read_text(std::filesystem::path(ARGAND_SOURCE_DIR) / "shaders/comp" / file);
    const std::regex declaration("const uint " + constant + " = (\\d+)u;");
    std::vector<std::uint32_t> defaults;
    for (std::sregex_iterator i(text.begin(), text.end(), declaration); i != std::sregex_iterator();
         ++i) {
        defaults.push_back(static_cast<std::uint32_t>(std::stoul((*i)[1])));
    }
    return defaults;
}

TEST(EveryKind, IsInThePlanForEverything) {
    const Plan plan = make_plan({}, {.cube_maps = true, .final_gather = true, .everything = true});
    EXPECT_EQ(plan.material_features(), MATERIAL_ALL);
    EXPECT_EQ(plan.light_kinds(), all_light_kinds);
}

// What needs the whole module of a kernel, and not the lean one.
TEST(EveryKind, OfAMaterialIsInLeanModulesOrNamedHere) {
    EXPECT_EQ(MATERIAL_ALL & ~MATERIAL_LEAN,
              LOBE_CLEAR | LOBE_COAT | MATERIAL_COAT | MATERIAL_FILM | MATERIAL_DISPERSION |
                  MATERIAL_SHEEN | MATERIAL_ANISOTROPY | MATERIAL_COAT_NORMAL | MATERIAL_NESTED);
    EXPECT_EQ(MATERIAL_LEAN & ~MATERIAL_PLAIN,
              MATERIAL_ALPHA | MATERIAL_PHONG | MATERIAL_ABSORPTION | MATERIAL_UNLIT);
    EXPECT_EQ(MATERIAL_PLAIN & ~MATERIAL_LEAN, 0u);
}

TEST(EveryKind, IsInTheKernelsByDefault) {
    EXPECT_EQ(defaults_of("material_features.glsl", "material_features"),
              (std::vector<std::uint32_t>{MATERIAL_ALL, MATERIAL_LEAN, MATERIAL_PLAIN}));
    EXPECT_EQ(defaults_of("scene_bindings.glsl", "light_kinds"),
              std::vector<std::uint32_t>{all_light_kinds});
}

} // namespace
} // namespace argand::testing
