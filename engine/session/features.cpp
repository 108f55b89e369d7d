#include "session/features.hpp"

#include "kernels/camera_rays.hpp"
#include "kernels/center_rays.hpp"
#include "kernels/feature_add.hpp"
#include "methods/lens.hpp"
#include "methods/plan_render.hpp"
#include "scene/objects.hpp"
#include "shared/feature_record.h"
#include "shared/path_records.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace argand {

namespace {

// Rays traced together, and so elements of the buffers.
constexpr std::uint64_t most_slots = 1u << 18;

/// Rays of the camera and what they hit, without light.
class FeatureTracer {
public:
    FeatureTracer(World& world, const Scene& scene, const RenderSettings& settings)
        : device_(world.device()), settings_(settings),
          crop_(settings.crop.value_or(CropRectangle{0, 0, settings.width, settings.height})),
          pixels_(static_cast<std::uint64_t>(crop_.width()) *
                  static_cast<std::uint64_t>(crop_.height())),
          samples_(std::clamp(settings.samples, 1u, most_feature_samples)),
          slots_(std::min(most_slots, pixels_ * samples_)) {
        RenderSettings plain = settings; // without photons, whose areas would be looked for
        plain.method = "path";
        scene_ =
            world.on_device(scene, plan_render(scene, world.surfaces(), plain, builtin_methods()));
        const CameraRecord camera =
            camera_with_lens(device_, scene_, scene.cameras[settings.camera], settings);
        camera_ = upload<CameraRecord>(device_, "camera", std::span(&camera, 1));
        rays_ = device_.allocate("feature rays", slots_ * sizeof(RayRecord));
        hits_ = device_.allocate("feature hits", slots_ * sizeof(HitRecord));
        paths_ = device_.allocate("feature paths", slots_ * sizeof(PathRecord));
        unneeded_ = unneeded(device_);
        layers_ = device_.allocate("feature path layers", slots_ * sizeof(LayersRecord));
        active_ = device_.allocate("active feature rays", slots_ * 4);
        traversal_ = make_traversal(device_, slots_);
    }

    std::uint64_t pixels() const { return pixels_; }
    std::uint32_t samples() const { return samples_; }
    Image empty_image() const {
        Image image{crop_.width(), crop_.height(), {}};
        image.pixels.resize(static_cast<std::size_t>(pixels_));
        return image;
    }

    /// What is in the middle of each pixel.
    std::vector<HitRecord> centers() {
        std::vector<HitRecord> all;
        all.reserve(static_cast<std::size_t>(pixels_));
        for (std::uint64_t first = 0; first < pixels_; first += slots_) {
            const EyeBatch batch = batch_of(first, std::min(slots_, pixels_ - first), 1);
            const auto trace = [&] {
                dispatch(device_,
                         kernels::center_rays{.camera = camera_,
                                              .rays = rays_,
                                              .active_slots = active_,
                                              .batch = batch,
                                              .constants = {.cropped = cropped()}},
                         batch.pixels);
                trace_rays(batch.pixels);
            };
            trace();
            if (download_word(device_, traversal_.unfinished) > 0) {
                traversal_.careful = true;
                trace();
            }
            const auto hits = download<HitRecord>(device_, hits_, batch.pixels);
            all.insert(all.end(), hits.begin(), hits.end());
        }
        return all;
    }

    /// Sums over the samples of each pixel.
    std::vector<FeatureRecord> sums() {
        const std::uint64_t pixels_at_once = std::max<std::uint64_t>(slots_ / samples_, 1);
        features_ = device_.allocate("features", pixels_ * sizeof(FeatureRecord));
        device_.fill(features_, 0);
        for (std::uint64_t first = 0; first < pixels_; first += pixels_at_once) {
            const EyeBatch batch =
                batch_of(first, std::min(pixels_at_once, pixels_ - first), samples_);
            add_samples(batch);
            if (!traversal_.careful && download_word(device_, traversal_.unfinished) > 0) {
                traversal_.careful = true;
                add_samples(batch);
            }
        }
        return download<FeatureRecord>(device_, features_, static_cast<std::size_t>(pixels_));
    }

private:
    bool cropped() const { return settings_.crop.has_value() || settings_.everything; }

    EyeBatch batch_of(std::uint64_t first, std::uint64_t pixels, std::uint32_t samples) const {
        EyeBatch batch{};
        batch.seed = settings_.seed;
        batch.first_pixel = static_cast<std::uint32_t>(first);
        batch.pixels = static_cast<std::uint32_t>(pixels);
        batch.samples = samples;
        batch.width = static_cast<std::uint32_t>(settings_.width);
        batch.height = static_cast<std::uint32_t>(settings_.height);
        batch.crop_x = static_cast<std::uint32_t>(crop_.x0);
        batch.crop_y = static_cast<std::uint32_t>(crop_.y0);
        batch.crop_width = static_cast<std::uint32_t>(crop_.width());
        return batch;
    }

    void trace_rays(std::uint32_t count) {
        device_.fill(traversal_.unfinished, 0);
        trace_closest(device_, scene_.bvh, traversal_, {rays_, active_, hits_, count});
    }

    void add_samples(const EyeBatch& batch) {
        const std::uint32_t slots = batch.pixels * batch.samples;
        const StageScope stage(device_, "features");
        dispatch(
            device_,
            kernels::camera_rays{.camera = camera_,
                                 .rays = rays_,
                                 .paths = paths_,
                                 .layers = layers_,
                                 .active_slots = active_,
                                 .eye_weights = unneeded_,
                                 .batch = batch,
                                 .constants = {.lattice = settings_.deterministic,
                                               .cones = scene_.plan.needs(Feature::mip_maps),
                                               .cropped = cropped(),
                                               .filtered = settings_.filter != PixelFilter::box}},
            slots);
        trace_rays(slots);
        dispatch(
            device_,
            kernels::feature_add{.scene = scene_.bindings(),
                                 .texture = scene_.texture_bindings(),
                                 .hits = hits_,
                                 .rays = rays_,
                                 .unfinished = traversal_.unfinished,
                                 .features = features_,
                                 .batch = batch,
                                 .constants = {.scene = scene_.constants(),
                                               .material_features = scene_.plan.material_features(),
                                               .texture = scene_.texture_constants()}},
            batch.pixels);
    }

    Device& device_;
    const RenderSettings& settings_;
    CropRectangle crop_;
    std::uint64_t pixels_;
    std::uint32_t samples_;
    std::uint64_t slots_;
    DeviceScene scene_;
    Buffer camera_, rays_, hits_, paths_, layers_, active_, features_, unneeded_;
    Traversal traversal_;
};

void add_means(FeatureTracer& tracer, const FeatureLayers& wanted, std::vector<Layer>& layers) {
    Image albedo = tracer.empty_image(), normal = tracer.empty_image();
    const float scale = 1.0f / static_cast<float>(tracer.samples());
    const std::vector<FeatureRecord> sums = tracer.sums();
    for (std::size_t i = 0; i < sums.size(); ++i) {
        const FeatureRecord& f = sums[i];
        albedo.pixels[i] = scale * glm::vec3(f.albedo_r, f.albedo_g, f.albedo_b);
        normal.pixels[i] = scale * glm::vec3(f.normal_x, f.normal_y, f.normal_z);
    }
    if (wanted.albedo) {
        layers.push_back({"albedo", std::move(albedo)});
    }
    if (wanted.normal) {
        layers.push_back({"normal", std::move(normal), "XYZ"});
    }
}

void add_centers(FeatureTracer& tracer, const Scene& scene, const FeatureLayers& wanted,
                 std::vector<Layer>& layers) {
    Image depth = tracer.empty_image(), id = tracer.empty_image();
    const std::vector<HitRecord> hits = tracer.centers();
    for (std::size_t i = 0; i < hits.size(); ++i) {
        const bool hit = hits[i].triangle != no_triangle;
        depth.pixels[i] = glm::vec3(hit ? hits[i].t : std::numeric_limits<float>::infinity());
        id.pixels[i] =
            glm::vec3(hit ? static_cast<float>(object_id(scene, hits[i].triangle)) : 0.0f);
    }
    if (wanted.depth) {
        layers.push_back({"depth", std::move(depth), "Z"});
    }
    if (wanted.id) {
        layers.push_back({"id", std::move(id), "Z"});
    }
}

} // namespace

bool add_feature(std::string_view name, FeatureLayers& layers) {
    for (const auto& [of_layer, layer] :
         {std::pair{"albedo", &FeatureLayers::albedo}, std::pair{"normal", &FeatureLayers::normal},
          std::pair{"depth", &FeatureLayers::depth}, std::pair{"id", &FeatureLayers::id},
          std::pair{"variance", &FeatureLayers::variance}}) {
        if (name == of_layer) {
            layers.*layer = true;
            return true;
        }
    }
    return false;
}

std::vector<Layer> render_features(World& world, const Scene& scene, const RenderSettings& settings,
                                   const FeatureLayers& wanted) {
    std::vector<Layer> layers;
    if (!wanted.any_first_hits()) {
        return layers;
    }
    FeatureTracer tracer(world, scene, settings);
    if (wanted.albedo || wanted.normal) {
        add_means(tracer, wanted, layers);
    }
    if (wanted.depth || wanted.id) {
        add_centers(tracer, scene, wanted, layers);
    }
    return layers;
}

} // namespace argand
