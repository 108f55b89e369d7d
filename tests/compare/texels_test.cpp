#include "device/kernel.hpp"
#include "kernels/footprint_gather.hpp"
#include "kernels/footprint_gather_texels.hpp"
#include "kernels/leaf_discs.hpp"
#include "kernels/leaf_discs_texels.hpp"
#include "kernels/leaf_footprints.hpp"
#include "kernels/leaf_footprints_texels.hpp"
#include "kernels/nearest_gather.hpp"
#include "kernels/nearest_gather_texels.hpp"
#include "kernels/photon_gather.hpp"
#include "kernels/photon_gather_texels.hpp"
#include "kernels/trace_any.hpp"
#include "kernels/trace_any_alpha.hpp"
#include "kernels/trace_any_alpha_texels.hpp"
#include "kernels/trace_any_texels.hpp"
#include "kernels/trace_closest.hpp"
#include "kernels/trace_closest_alpha.hpp"
#include "kernels/trace_closest_alpha_texels.hpp"
#include "kernels/trace_closest_texels.hpp"

#include <filesystem>
#include <gtest/gtest.h>
#include <string>
#include <utility>
#include <vector>

namespace argand {
namespace {

const std::vector<std::pair<const KernelInfo*, const KernelInfo*>> pairs = {
    {&kernels::footprint_gather::info, &kernels::footprint_gather_texels::info},
    {&kernels::leaf_discs::info, &kernels::leaf_discs_texels::info},
    {&kernels::leaf_footprints::info, &kernels::leaf_footprints_texels::info},
    {&kernels::nearest_gather::info, &kernels::nearest_gather_texels::info},
    {&kernels::photon_gather::info, &kernels::photon_gather_texels::info},
    {&kernels::trace_any_alpha::info, &kernels::trace_any_alpha_texels::info},
    {&kernels::trace_closest_alpha::info, &kernels::trace_closest_alpha_texels::info},
    {&kernels::trace_any::info, &kernels::trace_any_texels::info},
    {&kernels::trace_closest::info, &kernels::trace_closest_texels::info},
};

// A kernel that reads texels runs the twin of its variant that does not. The twin identifies
// buffers and constants by their order, so both must declare the same.
TEST(Texels, VariantsDeclareTheArgumentsOfTheirTwin) {
    for (const auto& [storage, texels] : pairs) {
        SCOPED_TRACE(texels->name);
        EXPECT_EQ(std::string(storage->name) + "_texels", texels->name);
        EXPECT_EQ(storage->host, texels->host);
        EXPECT_EQ(storage->push_bytes, texels->push_bytes);
        ASSERT_EQ(storage->bindings.size(), texels->bindings.size());
        for (std::size_t i = 0; i < storage->bindings.size(); ++i) {
            EXPECT_STREQ(storage->bindings[i].name, texels->bindings[i].name);
            EXPECT_EQ(storage->bindings[i].access, texels->bindings[i].access);
        }
        ASSERT_EQ(storage->constants.size(), texels->constants.size());
        for (std::size_t i = 0; i < storage->constants.size(); ++i) {
            EXPECT_STREQ(storage->constants[i].name, texels->constants[i].name);
        }
    }
}

TEST(Texels, EveryVariantIsInTheList) {
    std::size_t variants = 0;
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(ARGAND_SOURCE_DIR "/shaders/comp")) {
        variants += entry.path().stem().string().ends_with("_texels") ? 1u : 0u;
    }
    EXPECT_EQ(variants, pairs.size());
}

} // namespace
} // namespace argand
