// A plan with everything is every lobe and every kind of light: a new one that the plan or the
// kernels' defaults forget fails here (docs/adding.md).
#include "plan/plan.hpp"

#include "shared/bsdf.h"
#include "shared/light_record.h"
#include "support/scratch_directory.hpp"

#include <gtest/gtest.h>
#include <regex>

namespace argand::testing {
namespace {

/// The default of a specialization constant that a file of shaders/comp declares.
std::uint32_t default_of(const std::string& file, const std::string& constant) {
    const std::string text =
        read_text(std::filesystem::path(ARGAND_SOURCE_DIR) / "shaders/comp" / file);
    const std::regex declaration("const uint " + constant + " = (\\d+)u;");
    std::smatch match;
    EXPECT_TRUE(std::regex_search(text, match, declaration)) << file << ": " << constant;
    return match.empty() ? 0 : static_cast<std::uint32_t>(std::stoul(match[1]));
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
                  MATERIAL_SHEEN | MATERIAL_ANISOTROPY | MATERIAL_COAT_NORMAL);
    EXPECT_EQ(MATERIAL_LEAN & ~MATERIAL_PLAIN,
              MATERIAL_ALPHA | MATERIAL_PHONG | MATERIAL_ABSORPTION | MATERIAL_UNLIT);
    EXPECT_EQ(MATERIAL_PLAIN & ~MATERIAL_LEAN, 0u);
}

TEST(EveryKind, IsInTheKernelsByDefault) {
    EXPECT_EQ(default_of("material_features.glsl", "material_features"), MATERIAL_ALL);
    EXPECT_EQ(default_of("scene_bindings.glsl", "light_kinds"), all_light_kinds);
}

} // namespace
} // namespace argand::testing
