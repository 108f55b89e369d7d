// Tests which features a scene requires.
#include "plan/plan.hpp"

#include "methods/method_info.hpp"
#include "methods/moving_scene.hpp"
#include "methods/plan_render.hpp"
#include "scene/gltf.hpp"
#include "scene/studio.hpp"

#include <gmock/gmock.h>

namespace argand {
namespace {

using namespace argand::testing;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

std::set<Feature> features(const Plan& plan) {
    std::set<Feature> set;
    for (const auto& [feature, by] : plan.required) {
        set.insert(feature);
    }
    return set;
}

std::set<Feature> features(const Scene& scene, const PlanRequest& request = {}) {
    return features(make_plan(scene, request));
}

/// Features of `after` that `before` lacks.
std::set<Feature> added(const Scene& before, const Scene& after) {
    std::set<Feature> set = features(after);
    for (const Feature feature : features(before)) {
        EXPECT_TRUE(set.erase(feature) == 1) << text_of(feature).name;
    }
    return set;
}

Scene with_quad(Scene scene, const Material& material) {
    add_quad(scene, {-0.1f, 0, 0}, {0.2f, 0, 0}, {0, 0.2f, 0}, add_material(scene, material));
    return scene;
}

TEST(Plan, DiffuseBoxNeedsOnlyDiffuseFeatures) {
    EXPECT_THAT(features(room_scene()),
                UnorderedElementsAre(Feature::diffuse, Feature::point_light, Feature::direct_light,
                                     Feature::photon_map, Feature::differentials));
    EXPECT_THAT(
        features(room_scene(), {.photon_map = false}),
        UnorderedElementsAre(Feature::diffuse, Feature::point_light, Feature::direct_light));
    EXPECT_THAT(features(room_scene(), {.footprints = false, .final_gather = true}),
                UnorderedElementsAre(Feature::diffuse, Feature::point_light, Feature::direct_light,
                                     Feature::photon_map, Feature::final_gather));
    EXPECT_THAT(features(room_scene(), {.footprints = false, .cube_maps = true}),
                UnorderedElementsAre(Feature::diffuse, Feature::point_light, Feature::direct_light,
                                     Feature::photon_map, Feature::cube_maps));
}

TEST(Plan, GlassSphereAddsItsFeatures) {
    Scene scene = room_scene();
    add_sphere(scene, glm::vec3(0), 0.2f, 4, false, add_material(scene, glass(1.5f, true)));
    EXPECT_THAT(added(room_scene(), scene),
                UnorderedElementsAre(Feature::mirror, Feature::transmission, Feature::refraction,
                                     Feature::followed_paths, Feature::caustics));
    Scene smooth = room_scene();
    add_sphere(smooth, glm::vec3(0), 0.2f, 4, true, add_material(smooth, glass(1.5f, true)));
    EXPECT_THAT(added(scene, smooth), UnorderedElementsAre(Feature::smooth_normals));
}

TEST(Plan, FollowsWhatAMaterialBecomes) {
    Scene scene = changing_scene(); // its block becomes glass, and one of its walls shines
    const auto now = features(scene);
    EXPECT_FALSE(now.count(Feature::refraction) || now.count(Feature::emissive_triangles));
    PlanRequest any_time;
    any_time.at_any_time = true;
    RenderSettings settings;
    const std::string method = method_for(scene, settings).name;
    EXPECT_NE(method, method_for(room_scene(), settings).name);
    for (const double time : {0.5, 1.0, 0.0}) {
        move_to(time, scene);
        EXPECT_EQ(features(scene).count(Feature::refraction), time > 0 ? 1u : 0u) << time;
        EXPECT_EQ(features(scene).count(Feature::emissive_triangles), time > 0 ? 1u : 0u) << time;
        const auto ever = features(scene, any_time);
        EXPECT_TRUE(ever.count(Feature::refraction) && ever.count(Feature::caustics)) << time;
        EXPECT_TRUE(ever.count(Feature::diffuse)) << time; // the block at rest
        EXPECT_EQ(method_for(scene, settings).name, method) << time;
    }
}

TEST(Plan, EachMaterialAddsItsFeatures) {
    const Scene room = room_scene();
    EXPECT_THAT(added(room, with_quad(room, lambertian(glm::vec3(0.1f)))), IsEmpty());
    EXPECT_THAT(added(room, with_quad(room, mirror())),
                UnorderedElementsAre(Feature::mirror, Feature::followed_paths, Feature::caustics));
    EXPECT_THAT(added(room, with_quad(room, glass(1.5f, false))),
                UnorderedElementsAre(Feature::mirror, Feature::transmission,
                                     Feature::followed_paths, Feature::caustics));
    Material frosted = glass(1.5f, true);
    frosted.roughness = 0.5f;
    EXPECT_THAT(added(room, with_quad(room, frosted)),
                UnorderedElementsAre(Feature::refraction, Feature::rough_glass,
                                     Feature::followed_paths, Feature::caustics));
    for (const bool solid : {false, true}) {
        Material amber = glass(1.5f, solid);
        amber.absorption = {1, 2, 3};
        const auto found = added(room, with_quad(room, amber));
        EXPECT_EQ(std::count(found.begin(), found.end(), Feature::absorption), solid ? 1 : 0);
    }
    Scene solids = room;
    add_box(solids, glm::vec3(0), glm::vec3(0.5f), add_material(solids, glass(1.5f, true)), false);
    for (const float gap : {0.1f, -0.1f}) {
        Scene more = solids;
        add_box(more, glm::vec3(0.5f + gap), glm::vec3(0.9f), add_material(more, glass(1.3f, true)),
                false);
        const auto found = added(solids, more);
        EXPECT_EQ(std::count(found.begin(), found.end(), Feature::nested_solids), gap < 0 ? 1 : 0);
        EXPECT_EQ(std::count(found.begin(), found.end(), Feature::alpha), gap < 0 ? 1 : 0);
    }
    for (const float share : {0.0f, 1.0f}) {
        Material soap = mirror();
        soap.film = share;
        soap.coat = share;
        soap.coat_roughness = 0.5f;
        soap.sheen_color.g = share;
        const auto found = added(room, with_quad(room, soap));
        for (const Feature feature :
             {Feature::iridescence, Feature::coat, Feature::rough_coat, Feature::sheen}) {
            EXPECT_EQ(std::count(found.begin(), found.end(), feature), share > 0 ? 1 : 0);
        }
        Material brushed;
        brushed.anisotropy = {share, 0};
        const auto metals = added(room, with_quad(room, brushed));
        EXPECT_EQ(std::count(metals.begin(), metals.end(), Feature::anisotropy), share > 0 ? 1 : 0);
        Material prism = glass(1.5f, share > 0);
        prism.dispersion = 1;
        const auto colors = added(room, with_quad(room, prism));
        EXPECT_EQ(std::count(colors.begin(), colors.end(), Feature::dispersion), share > 0 ? 1 : 0);
    }
    Material label = lambertian(glm::vec3(0.5f));
    label.unlit = true;
    EXPECT_THAT(added(room, with_quad(room, label)), UnorderedElementsAre(Feature::unlit));
    Material metal;
    metal.roughness = 0.2f;
    EXPECT_THAT(added(room, with_quad(room, metal)),
                UnorderedElementsAre(Feature::ggx, Feature::followed_paths, Feature::caustics));
    EXPECT_THAT(features(with_quad(room, metal), {.follow_roughness = 0.1f}),
                ::testing::Contains(Feature::glossy_estimates));
    metal.roughness = 0.5f;
    EXPECT_THAT(added(room, with_quad(room, metal)),
                UnorderedElementsAre(Feature::ggx, Feature::glossy_estimates));
    Material plastic = lambertian(glm::vec3(0.5f));
    plastic.phong = Phong{glm::vec3(0.2f), 10};
    EXPECT_THAT(added(room, with_quad(room, plastic)),
                UnorderedElementsAre(Feature::phong, Feature::glossy_estimates));
    Material pane = lambertian(glm::vec3(0.5f));
    pane.coverage = 0.5f;
    EXPECT_THAT(added(room, with_quad(room, pane)), UnorderedElementsAre(Feature::alpha));
    Scene unused = room;
    add_material(unused, mirror());
    add_material(unused, emitter(glm::vec3(1)));
    EXPECT_THAT(added(room, unused), IsEmpty());
}

TEST(Plan, EachLightAddsItsFeatures) {
    const Scene room = room_scene();
    EXPECT_THAT(added(room, with_quad(room, emitter(glm::vec3(1)))),
                UnorderedElementsAre(Feature::emissive_triangles, Feature::several_lights));
    Scene scene = room;
    scene.lights.push_back(directional_light({0, -1, 0}, glm::vec3(1)));
    EXPECT_THAT(added(room, scene),
                UnorderedElementsAre(Feature::directional_light, Feature::several_lights));
    scene = room;
    scene.lights.push_back(spot_light({0, 0, 0}, {0, -1, 0}, glm::vec3(1), 0.1f, 0.2f));
    EXPECT_THAT(added(room, scene),
                UnorderedElementsAre(Feature::spot_light, Feature::several_lights));
    scene = room;
    scene.sky = glm::vec3(0);
    EXPECT_THAT(added(room, scene), IsEmpty());
    scene.sky = glm::vec3(1);
    EXPECT_THAT(added(room, scene), UnorderedElementsAre(Feature::sky, Feature::several_lights));
    Scene under_a_picture = room;
    under_a_picture.environment = studio();
    EXPECT_THAT(added(room, under_a_picture),
                UnorderedElementsAre(Feature::sky_picture, Feature::several_lights));
    under_a_picture.environment->strength = 0;
    EXPECT_THAT(added(room, under_a_picture), IsEmpty());
    scene.lights.clear();
    EXPECT_THAT(features(scene),
                UnorderedElementsAre(Feature::diffuse, Feature::sky, Feature::direct_light,
                                     Feature::photon_map, Feature::differentials));
    scene.sky.reset();
    EXPECT_FALSE(make_plan(scene, {}).needs(Feature::direct_light));
    EXPECT_EQ(make_plan(scene, {}).light_kinds(), 0u);
}

TEST(Plan, NamesTheObjectThatRequiresAFeature) {
    Scene scene = room_scene();
    scene.materials[0].name = "wall";
    scene.lights[0].name = "lamp";
    Material gold = mirror();
    gold.name = "gold";
    scene = with_quad(scene, gold);
    const Plan plan = make_plan(scene, {});
    EXPECT_EQ(plan.required.at(Feature::diffuse), "material 'wall'");
    EXPECT_EQ(plan.required.at(Feature::mirror), "material 'gold'");
    EXPECT_EQ(plan.required.at(Feature::caustics), "material 'gold'");
    EXPECT_EQ(plan.required.at(Feature::point_light), "light 'lamp'");
    EXPECT_EQ(plan.required.at(Feature::direct_light), "light 'lamp'");
    for (const Feature feature : all_features()) {
        EXPECT_STRNE(text_of(feature).key, "");
    }
}

TEST(Plan, EverythingRequiresAllFeatures) {
    const Plan plan = make_plan(
        {}, {.light_paths = true, .cube_maps = true, .final_gather = true, .everything = true});
    EXPECT_EQ(plan.required.size(), all_features().size());
    EXPECT_FALSE(
        make_plan({}, {.photon_map = false, .everything = true}).needs(Feature::differentials));
}

TEST(Plan, LightPathsRequirePhotonsWithoutAMap) {
    const Plan plan =
        make_plan(with_quad(room_scene(), mirror()), {.photon_map = false, .light_paths = true});
    EXPECT_TRUE(plan.needs(Feature::light_paths));
    EXPECT_TRUE(plan.needs(Feature::caustics));
    EXPECT_TRUE(plan.needs_photons());
    EXPECT_FALSE(plan.needs(Feature::photon_map));
    EXPECT_FALSE(make_plan({}, {.photon_map = false}).needs_photons());
}

} // namespace
} // namespace argand
