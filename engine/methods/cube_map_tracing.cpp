#include "methods/cube_map_tracing.hpp"

#include "base/error.hpp"
#include "methods/cube_map_options.hpp"
#include "scene/light_power.hpp"
#include "shared/cube_map.h"
#include "shared/photon.h"
#include "shared/random.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace argand {

namespace {

// The paper has 30 to 50 random points (section 4.1). Here some are where photons start, and some
// are in view.
constexpr std::uint32_t candidates_in_box = 24;
constexpr std::size_t most_candidates_at_lights = 24;
constexpr std::uint32_t candidates_in_view = 16;
constexpr std::size_t most_near_unseen = 16;
constexpr std::size_t most_fixed = 8; ///< centers at lights
constexpr std::uint32_t candidate_size = 32;
constexpr std::uint64_t emitted_for_starts = 256;
constexpr std::uint64_t emitted_for_places = 4096;
constexpr std::uint32_t bounces_for_places = 3;
constexpr std::size_t most_points = 2048; ///< of photons, and of points in view

/// Candidates for centers; the first `fixed` are taken in any case.
struct Candidates {
    std::vector<glm::vec3> places;
    std::vector<glm::vec4> starts; ///< of photons within the scene's box
    std::size_t fixed = 0;
};

bool is_in(const Bounds& box, const glm::vec3& place) {
    return glm::all(glm::lessThanEqual(box.low, place)) &&
           glm::all(glm::lessThanEqual(place, box.high));
}

/// Where a ray from outside enters the box.
std::optional<float> entry(const Bounds& box, const glm::vec3& origin, const glm::vec3& direction) {
    const glm::vec3 to_low = (box.low - origin) / direction;
    const glm::vec3 to_high = (box.high - origin) / direction;
    const glm::vec3 enter = glm::min(to_low, to_high);
    const glm::vec3 leave = glm::max(to_low, to_high);
    const float first = std::max({enter.x, enter.y, enter.z, 0.0f});
    return first <= std::min({leave.x, leave.y, leave.z}) ? std::optional(first) : std::nullopt;
}

/// The strongest lights that are points within the scene: photons from there need one lookup in the
/// light's own map.
std::vector<glm::vec3> point_lights(const Scene& scene, const Bounds& box, std::size_t most) {
    std::vector<std::pair<double, glm::vec3>> found;
    for (const Light& light : scene.lights) {
        if (light.kind != LightKind::directional && is_in(box, light.position)) {
            const glm::dvec3 power = emitted_power(light);
            found.emplace_back(-(power.r + power.g + power.b), light.position);
        }
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<glm::vec3> places;
    for (const auto& [minus_power, place] : found) {
        if (minus_power < 0 && places.size() < most) {
            places.push_back(place);
        }
    }
    return places;
}

PhotonPass pass_for(std::uint64_t count, std::uint32_t bounces) {
    return {.seed = 0x3a95u, .first = 0, .count = count, .bounces = bounces, .first_hits = true};
}

/// Every `step`-th of so many that `most` remain.
std::size_t step_for(std::size_t count, std::size_t most) {
    return std::max<std::size_t>((count + most - 1) / most, 1);
}

std::vector<glm::vec4> some_of(std::span<const glm::vec4> points, std::size_t most) {
    std::vector<glm::vec4> some;
    const std::size_t step = step_for(points.size(), most);
    for (std::size_t i = 0; i < points.size(); i += step) {
        some.push_back(points[i]);
    }
    return some;
}

/// Where photons start; of those from outside, on their way to the scene's box, at most this part
/// of its radius before it.
std::vector<glm::vec4> starts_of_photons(RenderContext& c) {
    constexpr float before_box = 0.3f;
    PhotonWorkspace workspace = make_photon_workspace(c.device, emitted_for_starts);
    std::vector<glm::vec4> starts;
    const Bounds& box = c.on_device.box;
    workspace.tracer = [&](const RayBatch& batch) {
        for (const RayRecord& ray : download<RayRecord>(c.device, batch.rays, workspace.slots)) {
            const glm::vec3 origin(ray.origin_x, ray.origin_y, ray.origin_z);
            const glm::vec3 direction(ray.direction_x, ray.direction_y, ray.direction_z);
            if (ray.t_max >= 0 && is_in(box, origin)) {
                starts.emplace_back(origin, 0);
            } else if (const std::optional<float> enters = entry(box, origin, direction);
                       ray.t_max >= 0 && enters) {
                const float u =
                    random4(0, static_cast<std::uint32_t>(starts.size()), 2, 0xce97e5u).x;
                const float before = before_box * c.on_device.record.radius * u * u;
                starts.emplace_back(origin + direction * std::max(*enters - before, 0.0f), 0);
            }
        }
        c.device.fill(batch.results, no_triangle); // nobody goes on
    };
    trace_photons(c.device, c.on_device, workspace, pass_for(emitted_for_starts, 0), 1e-6f);
    return starts;
}

/// Where photons lie that are traced through the candidates' maps, about.
std::vector<glm::vec4> places_of_photons(RenderContext& c, const CubeMaps& maps) {
    PhotonWorkspace workspace = make_photon_workspace(c.device, emitted_for_places);
    workspace.tracer = [&](const RayBatch& batch) {
        trace_cube_maps(c.device, c.on_device, maps, {.march = 16}, batch);
    };
    const std::optional<StoredPhotons> stored = trace_photons(
        c.device, c.on_device, workspace, pass_for(emitted_for_places, bounces_for_places), 1e-6f);
    std::vector<glm::vec4> places;
    for (const PhotonRecord& photon :
         download<PhotonRecord>(c.device, workspace.photons, stored ? stored->slots : 0)) {
        if (photon.normal != no_photon) {
            places.emplace_back(photon.x, photon.y, photon.z, 0);
        }
    }
    return places;
}

/// A CPU casts rays faster than it draws the triangles of any but small scenes, six times a map.
MapMaking making_of(RenderContext& c) {
    const std::optional<MapMaking> wanted = cube_map_options_of(c.settings).making;
    const bool can_draw = max_drawn_size(c.device) > 0;
    if (wanted == MapMaking::raster && !can_draw) {
        fail("drawing cube maps: '{}' has no rasteriser; try --maps cast, or another device with "
             "--device",
             c.device.info().name);
    }
    const bool draws = can_draw && c.device.info().kind != DeviceKind::cpu;
    return wanted ? *wanted : draws ? MapMaking::raster : MapMaking::cast;
}

/// Whether the device makes so many maps of this size.
bool fits(Device& device, std::uint64_t maps, std::uint32_t size, MapMaking making) {
    return cube_texels(size) * maps <= max_cube_texels(device) &&
           (making == MapMaking::cast || size <= max_drawn_size(device));
}

/// Maps of one layer around each place, of an even size that fits into a buffer.
CubeMaps make_candidates(RenderContext& c, const std::vector<glm::vec3>& places) {
    const MapMaking making = making_of(c);
    std::uint32_t size = candidate_size;
    while (size > 2 && !fits(c.device, places.size(), size, making)) {
        size /= 2;
    }
    return make_cube_maps(c.device, c.on_device, places, size, 1, making);
}

/// Adds a place on the way from the camera to a point in view. Nothing is in the way, unless the
/// point is seen by way of a mirror, or the camera is not a perspective one.
void add_toward(const RenderContext& c, const glm::vec4& query, float share,
                std::vector<glm::vec3>& places) {
    const glm::vec3 place =
        glm::mix(c.scene.cameras[c.settings.camera].position, glm::vec3(query), share);
    if (is_in(c.on_device.box, place)) {
        places.push_back(place);
    }
}

/// The lights that are centers in any case, of at most `most` centers.
std::vector<glm::vec3> lights_for_centers(const RenderContext& c, std::size_t most) {
    return point_lights(c.scene, c.on_device.box, std::min(most_fixed, most - 1));
}

Candidates find_candidates(RenderContext& c, std::span<const glm::vec4> queries, std::size_t most) {
    Candidates found;
    const Bounds& box = c.on_device.box;
    found.places = lights_for_centers(c, most);
    found.fixed = found.places.size();
    found.starts = starts_of_photons(c);
    for (const glm::vec4& start : some_of(found.starts, most_candidates_at_lights)) {
        const glm::vec3 place(start);
        if (std::find(found.places.begin(), found.places.end(), place) == found.places.end()) {
            found.places.push_back(place);
        }
    }
    std::erase_if(found.starts, [&](const glm::vec4& start) { return !is_in(box, start); });
    for (std::uint32_t i = 0; i < candidates_in_view && !queries.empty(); ++i) {
        const glm::vec4 u = random4(0, i, 1, 0xce97e5u);
        const auto query =
            static_cast<std::size_t>(double(u.x) * static_cast<double>(queries.size()));
        add_toward(c, queries[query], 0.3f + 0.6f * u.y, found.places);
    }
    for (const glm::vec3& place : random_centers(box, candidates_in_box, 0)) {
        found.places.push_back(place);
    }
    return found;
}

/// Whether rays go through maps: those of photons, or of eye paths.
bool needs_maps(const RenderContext& c) {
    const CubeMapOptions options = cube_map_options_of(c.settings);
    const bool has_photons = c.settings.photons > 0 && c.settings.bounces > 0;
    return c.on_device.record.light_count > 0 &&
           (has_photons || options.for_scattered || options.for_shadows);
}

/// The state of the surfaces of which maps are made: when they moved or changed last.
std::uint64_t surface_revision(const DeviceScene& scene) {
    std::uint64_t latest = scene.last_material_change;
    for (const MeshPlace& mesh : scene.meshes) {
        latest = std::max(latest, mesh.last_moved);
    }
    return latest;
}

class CubeMapTracing : public TracingStrategy {
public:
    void begin_frame(RenderContext& c, std::span<const glm::vec4> queries) override {
        queries_.assign(queries.begin(), queries.end());
        ++images_;
        const CubeMapOptions options = cube_map_options_of(c.settings);
        // Centers are kept until the maps miss more of what is in view than the coverage allows.
        const double most_unseen = unseen_ + 1 - options.centers.coverage;
        if (images_ >= options.choose_every ||
            (needs_maps(c) && !centers_.empty() && unseen_share(c) > most_unseen)) {
            centers_.clear();
        }
        follow(c);
    }

    void follow(RenderContext& c) override {
        if (!needs_maps(c)) {
            return;
        }
        if (centers_.empty() || !follow_lights(c)) {
            choose(c);
            images_ = 0;
            unseen_ = cube_map_options_of(c.settings).choose_every > 1 ? unseen_share(c) : 0;
            made_for_.reset();
        }
        if (made_for_ != surface_revision(c.on_device)) {
            make(c);
        }
    }

    void persist(Archive& archive, RenderContext& c) override {
        archive.values(centers_);
        archive.value(missing_);
        archive.value(images_);
        archive.value(unseen_);
        archive.value(at_lights_);
        if (centers_.empty()) { // they may be chosen yet
            archive.values(queries_);
        }
        if (archive.loads()) {
            const bool finite = std::all_of(centers_.begin(), centers_.end(), [](const auto& p) {
                return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
            });
            if (centers_.size() > most_centers || at_lights_ > centers_.size() || !finite) {
                fail("loading a saved state: it has no centers of cube maps for '{}'",
                     c.scene.name);
            }
            made_for_.reset();
            if (!centers_.empty()) {
                make(c);
            }
        }
    }

    PhotonTracer tracer(RenderContext& c) const override {
        return [this, &c, search = cube_map_options_of(c.settings).search](const RayBatch& rays) {
            trace_cube_maps(c.device, c.on_device, maps_, search, rays);
        };
    }

    EyeTracers eye_tracers(RenderContext& c) const override {
        const CubeMapOptions options = cube_map_options_of(c.settings);
        EyeTracers tracers;
        if (!needs_maps(c)) {
            return tracers;
        }
        if (options.for_scattered) {
            tracers.scattered = tracer(c);
        }
        if (options.for_shadows) {
            tracers.shadow = [this, &c, search = options.search](const RayBatch& rays,
                                                                 const Buffer& hits) {
                trace_cube_shadows(c.device, c.on_device, maps_, at_lights_, search, hits, rays);
            };
        }
        return tracers;
    }

    void report(RenderStatistics& statistics) const override {
        statistics.own["maps"] = static_cast<double>(centers_.size());
        statistics.own["map_size"] = static_cast<double>(maps_.size);
        statistics.own["map_layers"] = static_cast<double>(maps_.layers);
        statistics.own["images_since_choice"] = images_;
        statistics.own["maps_drawn"] = drawn_ ? 1 : 0;
        statistics.own["points_missed"] = missing_;
    }

private:
    void choose(RenderContext& c) {
        if (c.on_device.record.triangle_count == 0) {
            centers_ = {glm::vec3(0)}; // all photons escape
            missing_ = 0;
            at_lights_ = 0;
            return;
        }
        const CubeMapOptions options = cube_map_options_of(c.settings);
        Candidates candidates = find_candidates(c, queries_, options.centers.most);
        CubeMaps maps = make_candidates(c, candidates.places);
        std::vector<glm::vec4> points = some_of(queries_, most_points);
        const std::size_t in_view = points.size();
        for (const std::vector<glm::vec4>& more : {places_of_photons(c, maps), candidates.starts}) {
            const std::vector<glm::vec4> some = some_of(more, most_points);
            points.insert(points.end(), some.begin(), some.end());
        }
        const auto choose_among = [&] {
            return choose_centers(c.device, c.on_device, maps, candidates.fixed, points,
                                  options.centers);
        };
        ChosenCenters chosen = choose_among();
        // Points in view that no candidate sees have candidates of their own, in a second choice.
        std::erase_if(chosen.unseen, [&](std::size_t point) { return point >= in_view; });
        if (!chosen.unseen.empty()) {
            const std::size_t step = step_for(chosen.unseen.size(), most_near_unseen);
            const std::size_t before = candidates.places.size();
            for (std::size_t i = step / 2; i < chosen.unseen.size(); i += step) {
                add_toward(c, points[chosen.unseen[i]], 0.9f, candidates.places);
            }
            if (candidates.places.size() > before) {
                maps = make_candidates(c, candidates.places);
                chosen = choose_among();
            }
        }
        missing_ = chosen.missing;
        at_lights_ = candidates.fixed;
        centers_.clear();
        for (const std::size_t candidate : chosen.candidates) {
            centers_.push_back(candidates.places[candidate]);
        }
        if (centers_.empty()) { // nobody sees anything
            centers_.push_back(candidates.places.front());
        }
    }

    /// Moves the centers at lights to where these are now. Returns false if there are others.
    bool follow_lights(RenderContext& c) {
        if (c.on_device.record.triangle_count == 0) {
            return true;
        }
        const std::vector<glm::vec3> lights =
            lights_for_centers(c, cube_map_options_of(c.settings).centers.most);
        if (lights.size() != at_lights_) {
            return false;
        }
        if (!std::equal(lights.begin(), lights.end(), centers_.begin())) {
            std::copy(lights.begin(), lights.end(), centers_.begin());
            made_for_.reset();
        }
        return true;
    }

    /// Share of the points in view that no map around the centers shows.
    double unseen_share(RenderContext& c) const {
        const std::vector<glm::vec4> points = some_of(queries_, most_points);
        if (points.empty()) {
            return 0;
        }
        const std::vector<std::size_t> unseen =
            unseen_points(c.device, c.on_device, make_candidates(c, centers_), points);
        return static_cast<double>(unseen.size()) / static_cast<double>(points.size());
    }

    /// Makes the maps, as large as the device allows.
    void make(RenderContext& c) {
        std::uint32_t size = cube_map_options_of(c.settings).size;
        const std::uint32_t layers = layers_of(c.on_device);
        const MapMaking making = making_of(c);
        while (size > 1 && !fits(c.device, layers * centers_.size(), size, making)) {
            size /= 2;
        }
        maps_ = make_cube_maps(c.device, c.on_device, centers_, size, layers, making);
        drawn_ = making == MapMaking::raster;
        made_for_ = surface_revision(c.on_device);
    }

    std::vector<glm::vec4> queries_; ///< of the image
    std::vector<glm::vec3> centers_; ///< none as long as no ray goes through maps
    std::size_t at_lights_ = 0;      ///< the first of them
    std::uint32_t images_ = 0;       ///< since they were chosen
    double unseen_ = 0; ///< unseen_share() when they were chosen, if later images keep them
    double missing_ = 0;
    CubeMaps maps_;
    std::optional<std::uint64_t> made_for_; ///< their surface_revision()
    bool drawn_ = false;                    ///< by the rasteriser
};

} // namespace

std::unique_ptr<TracingStrategy> make_cube_map_tracing() {
    return std::make_unique<CubeMapTracing>();
}

} // namespace argand
