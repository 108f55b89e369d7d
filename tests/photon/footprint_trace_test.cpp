// Footprints of photons that the device has traced: how they cover surfaces, and the estimates from
// them.
#include "photon/map_queries.hpp"
#include "photon/radius.hpp"
#include "photon/smoothing.hpp"
#include "shared/footprint.h"
#include "shared/photon.h"
#include "world/world.hpp"

#include <algorithm>
#include <random>

namespace argand::testing {
namespace {

/// A stored photon, and the area of its footprint's ellipse before any smoothing.
struct Landed {
    glm::vec3 position{0};
    double area = 0;
    bool caustic = false;
    double flux = 0; ///< green
};

class FootprintTrace : public RenderTest {
protected:
    std::vector<Landed> trace(const Scene& scene, std::uint32_t bounces, std::uint64_t count,
                              std::uint32_t reemission = REEMIT_COSINE) {
        const DeviceScene on_device =
            upload_scene(device(), scene, make_plan(scene, {.follow_roughness = 0.25f}));
        PhotonWorkspace workspace =
            make_photon_workspace(device(), count, {.extents = extents_differentials});
        workspace.reemission = reemission;
        const auto stored = trace_photons(device(), on_device, workspace,
                                          {.seed = 5, .count = count, .bounces = bounces}, 1e-9f);
        EXPECT_TRUE(stored.has_value());
        const std::size_t slots = stored ? stored->slots : 0;
        const auto photons = download<PhotonRecord>(device(), workspace.photons, slots);
        const auto offsets = download<glm::uvec4>(device(), workspace.offsets, slots);
        std::vector<Landed> landed;
        for (std::size_t i = 0; i < slots; ++i) {
            const PhotonRecord& p = photons[i];
            if (p.normal != no_photon) {
                const glm::dvec3 u(unpack_dual(offsets[i].x, offsets[i].y));
                const glm::dvec3 v(unpack_dual(offsets[i].z, offsets[i].w));
                landed.push_back({{p.x, p.y, p.z},
                                  double(pi) * glm::length(glm::cross(u, v)),
                                  photon_is_caustic(p.normal),
                                  double(p.flux_g)});
            }
        }
        return landed;
    }
};

// Photons are stored from their second hit on, so they meet a mirror first. Where all photons come
// from the mirror, footprints are those of the light's image, and the mean of area × density is pi.
TEST_F(FootprintTrace, AreaTimesDensityIsPiAtTheFirstDiffuseHit) {
    const std::pair<const char*, Light> lights[] = {
        {"point", point_light({0.1f, 1, 0.2f}, glm::vec3(1))},
        {"spot", spot_light({0, 1, 0.1f}, {0.1f, -1, 0}, glm::vec3(1), 0.2f, 1.0f)},
        {"directional", directional_light({1, -1, 0}, glm::vec3(1))}};
    for (const float reflectance : {1.0f, 0.4f}) {
        for (const auto& [name, light] : lights) {
            SCOPED_TRACE(::testing::Message() << name << ", a mirror of " << reflectance);
            Scene scene;
            add_floor(scene, 6, 0, add_material(scene, mirror(glm::vec3(reflectance))));
            add_quad(scene, {-1.5f, 2, -1.5f}, {3, 0, 0}, {0, 0, 3},
                     add_material(scene, lambertian(glm::vec3(0.5f))));
            scene.lights = {light};
            const std::vector<Landed> landed = trace(scene, 1, 600'000);
            // The mean over photons is the integral of area × density over the number of photons,
            // and so is the sum of areas over a window's area.
            double sum = 0;
            int count = 0;
            for (const Landed& photon : landed) {
                if (std::abs(photon.position.x) < 1 && std::abs(photon.position.z) < 1 &&
                    photon.position.y > 1) {
                    EXPECT_TRUE(photon.caustic);
                    sum += photon.area;
                    ++count;
                }
            }
            EXPECT_GT(count, 1000);
            EXPECT_NEAR(sum / 4, double(pi), 0.05 * double(pi));
        }
    }
}

// Photons that pass a surface by its alpha keep their direction, and are thinned out as by
// roulette. Here they pass a veil before and after a mirror.
TEST_F(FootprintTrace, AreaTimesDensityIsPiBehindAlpha) {
    for (const float albedo : {0.0f, 0.8f}) {
        for (const Light& light : {point_light({0.1f, 1, 0.2f}, glm::vec3(1)),
                                   directional_light({1, -1, 0}, glm::vec3(1))}) {
            Scene scene;
            add_floor(scene, 6, 0, add_material(scene, mirror(glm::vec3(1))));
            add_quad(scene, {-1.5f, 2, -1.5f}, {3, 0, 0}, {0, 0, 3},
                     add_material(scene, lambertian(glm::vec3(0.5f))));
            Material veil = lambertian({albedo, 0, 0});
            veil.coverage = 0.3f;
            add_quad(scene, {-6, 0.5f, -6}, {12, 0, 0}, {0, 0.2f, 12}, add_material(scene, veil));
            scene.lights = {light};
            double sum = 0;
            double flux = 0;
            int count = 0;
            for (const Landed& photon : trace(scene, 1, 600'000)) {
                if (std::abs(photon.position.x) < 1 && std::abs(photon.position.z) < 1 &&
                    photon.position.y > 1 && photon.caustic) {
                    sum += photon.area;
                    flux += photon.flux;
                    ++count;
                }
            }
            EXPECT_GT(count, 1000);
            EXPECT_NEAR(sum / 4, double(pi), 0.05 * double(pi));
            if (light.kind == LightKind::directional) {
                EXPECT_NEAR(flux / 4, 0.7 * 0.7 / std::sqrt(2.0), 0.05 * 0.35);
            }
        }
    }
}

/// Median, quartiles and mean of area × density.
struct Spread {
    double mean = 0, quartile = 0, median = 0, upper_quartile = 0;
};

/// The same of photons on the walls of the box |x|, |y|, |z| <= 1; densities are those of cells
/// with edges of a quarter.
Spread spread_in_box(const std::vector<Landed>& landed) {
    const auto cell_of = [](glm::vec3 p) {
        const glm::vec3 size = glm::abs(p);
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        const auto place = [](float x) { return std::clamp(static_cast<int>((x + 1) * 4), 0, 7); };
        const int face = 2 * axis + (p[axis] > 0 ? 1 : 0);
        return static_cast<std::size_t>((face * 8 + place(p[(axis + 1) % 3])) * 8 +
                                        place(p[(axis + 2) % 3]));
    };
    std::vector<int> counts(6 * 64, 0);
    for (const Landed& photon : landed) {
        ++counts[cell_of(photon.position)];
    }
    std::vector<double> products;
    double sum = 0;
    for (const Landed& photon : landed) {
        products.push_back(photon.area * counts[cell_of(photon.position)] * 16);
        sum += photon.area / 24;
    }
    std::sort(products.begin(), products.end());
    const std::size_t n = products.size();
    return {sum, products[n / 4], products[n / 2], products[3 * n / 4]};
}

// After more bounces the mean is only about pi, because footprints do not account for photons whose
// paths cross. Independent spreads add 1 with each bounce; virtual origins multiply, and the
// paper's spacing is too large for directions that are sampled by cosine.
TEST_F(FootprintTrace, AreaTimesDensityAfterDiffuseReflection) {
    Scene box = box_scene(lambertian(glm::vec3(0.6f)));
    box.lights.push_back(point_light({0.2f, 0.4f, -0.1f}, glm::vec3(1)));
    constexpr std::uint64_t photons = 100'000;
    constexpr std::uint32_t depths = 3;
    // Photons of one batch are stored bounce after bounce, and take the same paths whatever their
    // limit.
    std::vector<std::ptrdiff_t> ends{0};
    for (std::uint32_t depth = 1; depth <= depths; ++depth) {
        ends.push_back(static_cast<std::ptrdiff_t>(trace(box, depth, photons).size()));
    }
    const auto spreads = [&](const char* name, std::uint32_t mode) {
        const std::vector<Landed> all = trace(box, depths, photons, mode);
        std::vector<Spread> result;
        for (std::size_t depth = 1; depth <= depths; ++depth) {
            result.push_back(
                spread_in_box({all.begin() + ends[depth - 1], all.begin() + ends[depth]}));
            const Spread& s = result.back();
            RecordProperty(fmt::format("{}_{}", name, depth),
                           fmt::format("mean {:.2f} pi, quartiles {:.2f} {:.2f} {:.2f}",
                                       s.mean / pi, s.quartile / pi, s.median / pi,
                                       s.upper_quartile / pi));
        }
        return result;
    };
    const std::vector<Spread> paper = spreads("paper", REEMIT_PAPER);
    const std::vector<Spread> cosine = spreads("cosine", REEMIT_COSINE);
    const std::vector<Spread> independent = spreads("independent", REEMIT_INDEPENDENT);
    EXPECT_NEAR(independent[0].mean, 2 * pi, 0.1 * 2 * pi);
    EXPECT_NEAR(independent[1].mean, 3 * pi, 0.1 * 3 * pi);
    for (std::size_t i = 0; i < depths; ++i) {
        EXPECT_GT(paper[i].median, cosine[i].median);
        EXPECT_GT(cosine[i].median, independent[i].median);
        EXPECT_GT(independent[i].median, pi);
        EXPECT_LT(independent[i].median, 2 * pi);
    }
}

// The integral of the estimate over all surfaces is the stored flux. Without samples of the
// surfaces' area, part of it is lost over their edges.
TEST_F(FootprintTrace, EstimateIntegratesToTheStoredFlux) {
    const double albedo = 0.5;
    Scene box = box_scene(lambertian(glm::vec3(float(albedo))));
    box.lights.push_back(point_light({0.2f, 0.4f, -0.1f}, glm::vec3(1)));
    const DeviceScene scene =
        upload_scene(device(), box, make_plan(box, {.follow_roughness = 0.25f}));
    constexpr std::uint64_t count = 50'000;
    PhotonWorkspace workspace =
        make_photon_workspace(device(), count, {.extents = extents_differentials});
    const auto stored = trace_photons(device(), scene, workspace,
                                      {.seed = 5, .count = count, .bounces = 0xffff}, 1e-9f);
    ASSERT_TRUE(stored.has_value());

    double flux = 0;
    for (const PhotonRecord& p :
         download<PhotonRecord>(device(), workspace.photons, stored->slots)) {
        flux += p.normal != no_photon ? double(p.flux_g) : 0;
    }
    std::mt19937 random(7);
    std::uniform_real_distribution<float> jitter;
    std::vector<Query> queries;
    std::vector<glm::vec4> points;
    constexpr int side = 24;
    for (int face = 0; face < 6; ++face) {
        for (int i = 0; i < side * side; ++i) {
            const int axis = face / 2;
            Query q{.position = glm::vec3(0), .normal = glm::vec3(0)};
            q.position[axis] = face % 2 == 0 ? -1.0f : 1.0f;
            q.normal[axis] = -q.position[axis];
            q.position[(axis + 1) % 3] = 2 * (float(i % side) + jitter(random)) / side - 1;
            q.position[(axis + 2) % 3] = 2 * (float(i / side) + jitter(random)) / side - 1;
            queries.push_back(q);
            points.emplace_back(q.position, 0);
        }
    }
    const auto scale_for = [&](float smoothing, float largest) {
        return make_footprint_scale(float(count), float(count), scene.record.radius,
                                    {smoothing, 5, largest, 0.3f, 1.0f / 6});
    };
    SortedPhotons sorted = sort_photons(device(), workspace, *stored);
    add_footprints(device(), workspace, scale_for(1, 1e6f), sorted);
    const double smoothing = median_smoothing(device(), sorted, points, 150);
    ASSERT_GT(smoothing, 0);

    const auto integral = [&](std::uint64_t area_samples) {
        const PhotonMap map = build_photon_map(
            device(), scene, workspace, *stored,
            {.area_samples = area_samples, .footprints = scale_for(float(smoothing), 0.3f)});
        EXPECT_EQ(map.area_samples, area_samples);
        bool finished = false;
        double sum = 0;
        FootprintEstimator estimator(device(), scene.plan);
        const std::vector<Gathered> sums =
            answers(device(), estimator, map, queries, {.until_complete = true}, finished);
        for (const Gathered& g : sums) {
            sum += g.indirect.g;
        }
        // Radiance is albedo / pi of irradiance; the box has an area of 24.
        return sum / static_cast<double>(queries.size()) * 24 * double(pi) / albedo;
    };
    const double plain = integral(0);
    const double corrected = integral(60'000);
    EXPECT_RELATIVE(corrected, flux, 0.02);
    EXPECT_LT(plain, 0.98 * flux);
    RecordProperty("lost_off_edges", std::to_string(1 - plain / flux));
}

// The scene's unit of length cancels: a model in millimetres gives the same picture as one in
// kilometres, but for photons that rounding sends another way.
TEST_F(FootprintTrace, PictureDoesNotDependOnTheScale) {
    RenderSettings settings = settings_of("footprints", 32, 4);
    settings.query_cell = 0; // queries enter cells at random, by the bits of their positions
    settings.photons = 20'000;
    const Scene room = room_scene();
    const RenderResult expected = render(room, settings);
    for (const float factor : {1e-3f, 1e3f}) {
        const RenderResult other = render(scaled(room, factor), settings);
        EXPECT_RELATIVE(other.statistics.smoothing, expected.statistics.smoothing, 0.01);
        EXPECT_RELATIVE(other.statistics.mean_footprints, expected.statistics.mean_footprints,
                        0.02);
        EXPECT_LT(compare(layer(other, "indirect"), layer(expected, "indirect")).rel_mse, 1e-4)
            << factor;
    }
}

// Figure 4 of Fabianowski and Dingliana 2009: one map gives a sharp caustic and other light that is
// smooth.
TEST_F(FootprintTrace, SlowRingCausticIsSharpAndTheRestSmooth) {
    const Scene ring = load_asset("ring.glb");
    RenderSettings settings = settings_of("photons", 64, 8);
    settings.least_coverage = 0; // as in the paper; beside the ring eye paths would go on
    settings.photons = 4'000'000;
    settings.photons_per_pass = settings.photons;
    settings.radius = 0.02; // an eightieth of the ring's
    const RenderResult truth = render(ring, settings);
    settings.radius.reset();
    settings.photons = 400'000;
    const RenderResult discs = render(ring, settings);
    settings.method = "footprints";
    const RenderResult footprints = render(ring, settings);
    // The largest errors are at the caustic's edge.
    EXPECT_LT(compare(layer(footprints, "caustic"), layer(truth, "caustic")).rmse,
              0.95 * compare(layer(discs, "caustic"), layer(truth, "caustic")).rmse);
    EXPECT_RELATIVE(mean(layer(footprints, "caustic")).g, mean(layer(truth, "caustic")).g, 0.05);
    // A few thousand photons blur into places that the ring hides from the light.
    EXPECT_RELATIVE(mean(layer(footprints, "indirect")).g, mean(layer(truth, "indirect")).g, 0.8);
    const auto roughness = [](const Image& image) {
        double sum = 0;
        for (int y = 0; y < image.height; ++y) {
            for (int x = 1; x < image.width; ++x) {
                const std::size_t i = static_cast<std::size_t>(y * image.width + x);
                sum += std::abs(double(image.pixels[i].g) - image.pixels[i - 1].g);
            }
        }
        return sum / static_cast<double>(image.pixels.size()) / mean(image).g;
    };
    EXPECT_LT(roughness(layer(footprints, "indirect")),
              0.7 * roughness(layer(footprints, "caustic")));
}

// All variants estimate the same light.
TEST_F(FootprintTrace, OptionsOfThePaperChangeTheNoiseNotTheLight) {
    RenderSettings settings = settings_of("footprints", 32, 16);
    // Given, because learning would undo the effect of the exponent.
    settings.footprints.smoothing = 5;
    settings.photons = 50'000;
    const Scene room = room_scene();
    const Image expected = layer(render(room, settings), "indirect");
    for (bool FootprintSettings::*option :
         {&FootprintSettings::paper_axes, &FootprintSettings::paper_reemission,
          &FootprintSettings::uniform_kernel, &FootprintSettings::fixed_smoothing}) {
        RenderSettings other = settings;
        other.footprints.*option = true;
        const Image image = layer(render(room, other), "indirect");
        EXPECT_FALSE(same_bits(image, expected));
        EXPECT_RELATIVE(mean(image).g, mean(expected).g, 0.03);
        EXPECT_LT(compare(image, expected).rel_mse, 0.05);
    }
}

} // namespace
} // namespace argand::testing
