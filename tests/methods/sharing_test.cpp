// Nearby eye paths share answers of the photon map.
#include "rendering.hpp"

namespace argand::testing {
namespace {

class Sharing : public RenderTest {
protected:
    RenderResult with_cells(const Scene& scene, const std::string& method, double cell,
                            std::uint32_t samples = 8) {
        RenderSettings settings = settings_of(method, 64, samples);
        settings.photons = 50'000;
        settings.query_cell = cell;
        return render(scene, settings);
    }
};

double error(const RenderResult& result, const RenderResult& truth, const char* of = "indirect") {
    return compare(layer(result, of), layer(truth, of)).rel_mse;
}

TEST_F(Sharing, SlowIsAsNearToWhatTheMapHolds) {
    for (const char* name : {"cornell_point.glb", "cornell_glass.glb", "glossy.glb"}) {
        const Scene scene = load_asset(name);
        for (const char* method : {"photons", "footprints"}) {
            SCOPED_TRACE(std::string(name) + ", " + method);
            // Every path has a cell of its own. (Without cells, every other sample queries.)
            const RenderResult truth = with_cells(scene, method, 1e-6, 64);
            const RenderResult own = with_cells(scene, method, 1e-6);
            const RenderResult shared = with_cells(scene, method, RenderSettings().query_cell);
            EXPECT_TRUE(same_bits(layer(own, "direct"), layer(shared, "direct")));
            EXPECT_FALSE(same_bits(layer(own, "indirect"), layer(shared, "indirect")));
            // The error of density estimation is ten times as large.
            EXPECT_LT(error(shared, truth), error(own, truth) + 0.004);
            EXPECT_LT(error(shared, truth, ""), error(own, truth, "") + 0.001);
            // Shared answers in sharp caustics would be off by 1.
            EXPECT_LE(error(shared, truth, "caustic"), error(own, truth, "caustic") + 0.1);
            for (const char* of : {"indirect", "caustic"}) {
                EXPECT_RELATIVE(mean(layer(shared, of)).g, mean(layer(truth, of)).g, 0.02) << of;
            }
        }
    }
}

TEST_F(Sharing, LargeCellsBlurButLoseNothing) {
    const Scene scene = load_asset("cornell_area.glb");
    const RenderResult own = with_cells(scene, "photons", 0, 32);
    const RenderResult small = with_cells(scene, "photons", 0.1, 32);
    const RenderResult large = with_cells(scene, "photons", 2, 32);
    EXPECT_LT(4 * error(small, own), error(large, own));
    EXPECT_RELATIVE(mean(layer(large, "indirect")).g, mean(layer(own, "indirect")).g, 0.03);
}

TEST_F(Sharing, QueriesAtDifferentVerticesAreAnsweredTogether) {
    const auto runs = [&](const char* stage) {
        std::uint64_t found = 0;
        for (const StageTime& time : device().stage_times()) {
            found += time.name == stage ? time.runs : 0;
        }
        return found;
    };
    device().reset_stage_times();
    with_cells(load_asset("cornell_glass.glb"), "photons", RenderSettings().query_cell, 1);
    // Paths through glass have more than ten vertices, but hardly more than two query the map. Some
    // paths of a small image are answered before the image's own.
    EXPECT_GT(runs("trace eye rays"), 20u);
    EXPECT_LE(runs("gather photons"), 16u);
}

} // namespace
} // namespace argand::testing
