// Photons that find their hits in cube maps, against those that find them through the tree.
#include "rendering.hpp"
#include "session/shutter.hpp"
#include "world/world.hpp"

#include <gmock/gmock.h>

namespace argand::testing {
namespace {

RenderSettings cube_settings(int size = 48) {
    RenderSettings settings = settings_of("image-space", size, 8);
    settings.own.clear();
    return settings;
}

class ImageSpace : public RenderTest {
protected:
    /// Expects the mean of the indirect light of `photons`, and its picture, within these bounds.
    void expect_indirect_of_photons(const std::string& asset, double mean_tolerance, double error) {
        const Scene scene = load_asset(asset);
        const RenderResult found = render(scene, cube_settings(32));
        RenderSettings settings = cube_settings(32);
        settings.method = "photons";
        const RenderResult expected = render(scene, settings);
        EXPECT_TRUE(same_bits(layer(found, "direct"), layer(expected, "direct")));
        for (int channel = 0; channel < 3; ++channel) {
            EXPECT_RELATIVE(mean(layer(found, "indirect"))[channel],
                            mean(layer(expected, "indirect"))[channel], mean_tolerance)
                << asset;
        }
        EXPECT_LT(compare(layer(found, ""), layer(expected, "")).rel_mse, error) << asset;
    }
};

TEST_F(ImageSpace, HasTheLightOfPhotonsInABox) {
    expect_indirect_of_photons("cornell_area.glb", 0.02, 0.004);
}

TEST_F(ImageSpace, SlowHasTheLightOfPhotonsElsewhere) {
    expect_indirect_of_photons("cornell_point.glb", 0.02, 0.004);
    expect_indirect_of_photons("cornell_glass.glb", 0.03, 0.01);
    expect_indirect_of_photons("closed_room.glb", 0.02, 0.004);
    expect_indirect_of_photons("courtyard.glb", 0.25, 0.02); // from the sky; see the results
    expect_indirect_of_photons("forty_rooms.glb", 0.03, 0.01);
    // The sun on the ground outside is 10^9 times as bright as the lamp within.
    expect_indirect_of_photons("sunlit_ground.glb", 0.05, 0.02);
}

TEST_F(ImageSpace, LittleFluxIsLostInABox) {
    const RenderStatistics statistics =
        render(load_asset("cornell_area.glb"), cube_settings(16)).statistics;
    for (std::size_t channel = 0; channel < 3; ++channel) {
        const FluxSums& flux = statistics.flux;
        EXPECT_EQ(flux.emitted[channel], flux.absorbed[channel] + flux.escaped[channel] +
                                             flux.cut[channel] + flux.lost[channel]);
        EXPECT_LT(flux.lost[channel], 0.01 * static_cast<double>(flux.emitted[channel]));
    }
    EXPECT_GE(statistics.own.at("maps"), 1);
    EXPECT_LE(statistics.own.at("maps"), 8);
    EXPECT_EQ(statistics.own.at("map_size"), 128);
    EXPECT_EQ(statistics.own.at("map_layers"), 1);
    EXPECT_LE(statistics.own.at("points_missed"), 0.01);
}

TEST_F(ImageSpace, SlowHasAtMostAsManyMapsAsRequested) {
    const Scene scene = load_asset("cornell_point.glb");
    for (const char* count : {"1", "3", "30"}) {
        RenderSettings settings = cube_settings(8);
        settings.own["maps-count"] = count;
        settings.own["map-size"] = "16";
        const double maps = render(scene, settings).statistics.own.at("maps");
        EXPECT_LE(maps, std::stod(count));
        EXPECT_GE(maps, std::min(std::stod(count), 3.0));
    }
}

TEST_F(ImageSpace, SearchesAsPublishedOnRequest) {
    const Scene scene = load_asset("cornell_area.glb");
    RenderSettings settings = cube_settings(24);
    settings.own = {{"map-hits", "points"}, {"march", "0"}, {"maps-count", "8"}};
    const FluxSums flux = render(scene, settings).statistics.flux;
    EXPECT_GT(flux.lost[1], 0.005 * static_cast<double>(flux.emitted[1]));
    EXPECT_LT(flux.lost[1], 0.5 * static_cast<double>(flux.emitted[1]));
}

class EyePathsThroughMaps : public ImageSpace {
protected:
    struct Pair {
        RenderResult rays, maps;
    };

    /// The picture with the option's eye paths through the tree, and through maps.
    Pair render_both(const std::string& asset, const char* option, std::uint64_t photons) {
        const Scene scene = load_asset(asset);
        RenderSettings settings = cube_settings(32);
        settings.photons = photons;
        Pair pair{.rays = render(scene, settings), .maps = {}};
        settings.own[option] = "maps";
        pair.maps = render(scene, settings);
        return pair;
    }

    void expect_direct_light(const std::string& asset, double mean_tolerance, double error) {
        const auto [rays, maps] = render_both(asset, "shadows", 20'000);
        EXPECT_RELATIVE(mean(layer(maps, "direct")).g, mean(layer(rays, "direct")).g,
                        mean_tolerance)
            << asset;
        EXPECT_LT(compare(layer(maps, "direct"), layer(rays, "direct")).rel_mse, error) << asset;
        EXPECT_FALSE(same_bits(layer(maps, "direct"), layer(rays, "direct"))) << asset;
        EXPECT_EQ(maps.statistics.flux.absorbed, rays.statistics.flux.absorbed);
    }
};

TEST_F(EyePathsThroughMaps, ShadowsAreThoseOfRays) {
    expect_direct_light("cornell_point.glb", 0.005, 0.002);
    expect_direct_light("cornell_area.glb", 0.02, 0.01);
}

TEST_F(EyePathsThroughMaps, SlowShadowsAreThoseOfRaysElsewhere) {
    expect_direct_light("spot.glb", 0.01, 0.01);
    expect_direct_light("cutouts.glb", 0.05, 0.05);
    expect_direct_light("veil.glb", 0.02, 0.01);
    expect_direct_light("closed_room.glb", 0.02, 0.01);
}

TEST_F(EyePathsThroughMaps, MirrorsShowWhatRaysShow) {
    const auto [rays, maps] = render_both("cornell_mirror.glb", "reflections", 20'000);
    EXPECT_FALSE(same_bits(layer(maps, ""), layer(rays, "")));
    EXPECT_RELATIVE(mean(layer(maps, "")).g, mean(layer(rays, "")).g, 0.01);
    EXPECT_LT(compare(layer(maps, ""), layer(rays, "")).rel_mse, 0.01);
}

// Centers are candidates on the lamp, too. They are not its shadow maps, which would show the
// lamp's own other side.
TEST_F(EyePathsThroughMaps, SmallLampsDoNotShadowThemselves) {
    Scene scene = box_scene(lambertian(glm::vec3(0.5f)));
    add_sphere(scene, {0.1f, 0.4f, 0.2f}, 0.01f, 8, false,
               add_material(scene, emitter(glm::vec3(1000))));
    scene.cameras = {look_at({0, 0, 0.95f}, {0, 0, -1}, 80)};
    RenderSettings settings = cube_settings(24);
    settings.photons = 5000;
    const RenderResult rays = render(scene, settings);
    settings.own["shadows"] = "maps";
    const RenderResult maps = render(scene, settings);
    EXPECT_RELATIVE(mean(layer(maps, "direct")).g, mean(layer(rays, "direct")).g, 0.05);
}

TEST_F(EyePathsThroughMaps, DoNotDependOnTheImageBefore) {
    // Two lights, of which paths learn which one to prefer.
    Scene scene = load_asset("cornell_mirror.glb");
    scene.lights.push_back(point_light({0.5f, 0.3f, 0.5f}, glm::vec3(0.3f)));
    RenderSettings settings = cube_settings(16);
    settings.photons = 5000;
    settings.own = {{"shadows", "maps"}, {"reflections", "maps"}};
    World world(device(), scene);
    Session session(world, scene, settings);
    std::vector<Image> images;
    for (int i = 0; i < 2; ++i) {
        session.begin_frame(0);
        while (const std::optional<PassPlan> plan = session.next_pass()) {
            EXPECT_TRUE(session.step(*plan, [](double) { return true; }));
        }
        images.push_back(layer(session.result(), ""));
    }
    EXPECT_TRUE(same_bits(images[0], images[1]));
}

TEST_F(EyePathsThroughMaps, NeedNoPhotons) {
    const auto [rays, maps] = render_both("cornell_point.glb", "shadows", 0);
    EXPECT_RELATIVE(mean(layer(maps, "")).g, mean(layer(rays, "")).g, 0.005);
    EXPECT_FALSE(same_bits(layer(maps, ""), layer(rays, "")));
}

TEST_F(ImageSpace, RendersWithoutAnythingToTrace) {
    Scene empty;
    empty.cameras = load_asset("cornell_point.glb").cameras;
    EXPECT_EQ(mean(layer(render(empty, cube_settings(8)), "")), glm::dvec3(0));
    Scene dark = load_asset("cornell_point.glb");
    dark.lights.clear();
    EXPECT_EQ(mean(layer(render(dark, cube_settings(8)), "indirect")), glm::dvec3(0));
}

// Of a film, or while the shutter is open.
class MovingImageSpace : public RenderTest {
protected:
    struct Film {
        std::vector<Image> pictures;      ///< indirect light
        std::vector<double> since_choice; ///< images for which the centers were kept
    };

    /// Moments of dynamic_block, from the first one on so many of four.
    Film film(const std::string& method, const std::string& choose_every, double speed = 1) {
        RenderSettings settings = settings_of(method, 24, 8);
        settings.photons = 50'000;
        if (method == "image-space") {
            settings.own = {{"choose-every", choose_every}};
        }
        Scene scene = load_asset("dynamic_block.glb");
        World world(device(), scene);
        Session session(world, scene, settings);
        Film found;
        for (int frame = 0; frame < 4; ++frame) {
            move_to(0.25 * speed * frame * longest_animation(scene), scene);
            world.update(scene);
            session.begin_frame(0);
            while (const std::optional<PassPlan> plan = session.next_pass()) {
                EXPECT_TRUE(session.step(*plan, [](double) { return true; }));
            }
            const RenderResult result = session.result();
            found.pictures.push_back(layer(result, "indirect"));
            if (method == "image-space") {
                found.since_choice.push_back(result.statistics.own.at("images_since_choice"));
            }
        }
        return found;
    }
};

TEST_F(MovingImageSpace, MapsFollowWhatMoves) {
    const std::vector<Image> photons = film("photons", "").pictures;
    for (const char* every : {"1", "3"}) {
        const Film found = film("image-space", every);
        for (std::size_t i = 0; i < photons.size(); ++i) {
            EXPECT_LT(compare(found.pictures[i], photons[i]).rel_mse, 0.004)
                << every << ", image " << i;
        }
        if (*every == '1') {
            EXPECT_EQ(found.since_choice, std::vector<double>(4, 0));
        } else { // the block uncovers what the first maps do not show
            EXPECT_EQ(found.since_choice[1], 0);
        }
    }
    // The block moves.
    EXPECT_GT(compare(photons[1], photons[0]).rel_mse, 0.02);
}

TEST_F(MovingImageSpace, SlowCentersAreKeptWhileTheyShowAsMuch) {
    EXPECT_EQ(film("image-space", "3", 0.01).since_choice, (std::vector<double>{0, 1, 2, 0}));
}

TEST_F(MovingImageSpace, CentersFollowLights) {
    const auto indirect = [&](const char* method) {
        Scene scene = load_asset("cornell_point.glb");
        RenderSettings settings = settings_of(method, 16, 4);
        settings.photons = 20'000;
        if (settings.method == "image-space") {
            settings.own = {{"choose-every", "10"}};
        }
        World world(device(), scene);
        Session session(world, scene, settings);
        RenderResult result;
        for (const float height : {1.5f, 0.2f}) {
            scene.lights.at(0).position = {0.8f, height, 0.8f};
            world.update(scene);
            session.begin_frame(0);
            while (const std::optional<PassPlan> plan = session.next_pass()) {
                EXPECT_TRUE(session.step(*plan, [](double) { return true; }));
            }
            result = session.result();
        }
        if (settings.method == "image-space") {
            EXPECT_EQ(result.statistics.own.at("images_since_choice"), 1);
        }
        return mean(layer(result, "indirect")).g;
    };
    EXPECT_RELATIVE(indirect("image-space"), indirect("photons"), 0.05);
}

TEST_F(MovingImageSpace, MapsFollowWhatMovesWhileTheShutterIsOpen) {
    Scene scene = load_asset("dynamic_block.glb");
    const auto blurred = [&](const char* method) {
        RenderSettings settings = settings_of(method, 24, 8);
        settings.photons = 100'000;
        World world(device(), scene);
        Session session(world, scene, with_pass_per_sample(settings));
        return layer(render_through(session, world, scene, {0, longest_animation(scene)}, 0,
                                    [](double) { return true; }),
                     "indirect");
    };
    EXPECT_LT(compare(blurred("image-space"), blurred("photons")).rel_mse, 0.008);
}

TEST_F(ImageSpace, SlowSplatsOfOneDensityAreDiscs) {
    const Scene scene = load_asset("cornell_area.glb");
    RenderSettings settings = cube_settings(32);
    const RenderResult discs = render(scene, settings);
    settings.own = {{"estimate", "splats"}, {"least-density", "1"}, {"most-density", "1"}};
    const RenderResult splats = render(scene, settings);
    // Splats have no support of their own: discs end at their height in another way.
    EXPECT_LT(compare(layer(splats, "indirect"), layer(discs, "indirect")).rel_mse, 1e-4);
    EXPECT_EQ(splats.statistics.flux.absorbed, discs.statistics.flux.absorbed);
}

TEST_F(ImageSpace, SplatsRefuseOptionsThatContradict) {
    const Scene scene = load_asset("cornell_point.glb");
    RenderSettings settings = cube_settings(4);
    settings.own = {{"estimate", "splats"}, {"least-density", "8"}};
    EXPECT_THROW(render(scene, settings), UsageError);
    settings.own = {{"estimate", "splats"}};
    settings.disc.ball = true;
    EXPECT_THROW(render(scene, settings), UsageError);
}

TEST_F(ImageSpace, SlowSplatsHaveTheLightOfDiscs) {
    for (const char* asset : {"cornell_area.glb", "ring.glb"}) {
        const Scene scene = load_asset(asset);
        RenderSettings settings = cube_settings(32);
        settings.photons = 100'000;
        const RenderResult discs = render(scene, settings);
        for (const char* size : {"auto", "16"}) {
            settings.own = {{"estimate", "splats"}, {"splat-size", size}};
            const RenderResult splats = render(scene, settings);
            EXPECT_RELATIVE(mean(layer(splats, "")).g, mean(layer(discs, "")).g, 0.02) << asset;
        }
    }
}

TEST_F(ImageSpace, DrawnMapsGiveThePictureOfCastOnes) {
    if (!device().raster()) {
        GTEST_SKIP() << device().info().name << " has no rasteriser";
    }
    for (const char* asset : {"cornell_area.glb", "veil.glb"}) {
        const Scene scene = load_asset(asset);
        RenderSettings settings = cube_settings(16);
        settings.photons = 20'000;
        settings.own["maps"] = "cast";
        const RenderResult cast = render(scene, settings);
        settings.own["maps"] = "raster";
        const RenderResult drawn = render(scene, settings);
        EXPECT_EQ(cast.statistics.own.at("maps_drawn"), 0);
        EXPECT_EQ(drawn.statistics.own.at("maps_drawn"), 1);
        EXPECT_LT(compare(layer(drawn, ""), layer(cast, "")).rel_mse, 1e-3) << asset;
    }
}

TEST_F(ImageSpace, RefusesToDrawWithoutARasteriser) {
    Device& device = open({"no raster", "raster", ""});
    const Scene scene = load_asset("cornell_point.glb");
    RenderSettings settings = cube_settings(4);
    EXPECT_EQ(testing::render(device, scene, settings).statistics.own.at("maps_drawn"), 0);
    settings.own["maps"] = "raster";
    try {
        testing::render(device, scene, settings);
        FAIL() << "nothing can draw";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), ::testing::HasSubstr("has no rasteriser; try --maps cast"));
    }
}

TEST_F(ImageSpace, MapsShrinkToWhatTheDeviceAddresses) {
    Device& small = open({"small", "", "storage_range=4MiB"});
    RenderSettings settings = cube_settings(8);
    settings.photons = 1000;
    settings.own = {{"map-size", "512"}, {"maps-count", "4"}};
    const Scene scene = load_asset("cornell_point.glb");
    EXPECT_EQ(testing::render(small, scene, settings).statistics.own.at("map_size"), 128);
    Device& tiny = open({"tiny", "", "storage_range=4MiB,image=16"});
    if (tiny.raster()) {
        settings.own["maps"] = "raster";
        EXPECT_EQ(testing::render(small, scene, settings).statistics.own.at("map_size"), 128);
        EXPECT_EQ(testing::render(tiny, scene, settings).statistics.own.at("map_size"), 16);
    }
}

} // namespace
} // namespace argand::testing
