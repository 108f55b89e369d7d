#include "methods/light_paths.hpp"
#include "methods/persist_buffer.hpp"
#include "methods/photon_numbers.hpp"
#include "methods/photon_targets.hpp"
#include "methods/render_options.hpp"
#include "methods/sample_passes.hpp"
#include "methods/small_image.hpp"
#include "methods/traced_photons.hpp"
#include "shared/random.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

namespace argand {

namespace {

// Bounds of a pass, whose light paths cannot be interrupted. A pass has at most so many samples of
// each pixel, but more in small images, where few eye paths would not fill a device. It has at most
// so many photons, unless one sample has more.
constexpr double most_samples = 16;
constexpr double eye_paths_of_small_image = 1 << 16;
constexpr double most_photons = 1 << 20;

Option light_paths_option() {
    Option option = own_option("light-paths",
                               "Light paths that are connected with the eye, for each sample of a "
                               "pixel; 0: none, as in `path`",
                               OptionKind::number, "1");
    option.low = 0;
    option.high = 1000;
    option.sweep.full = {"0.25", "1", "4"};
    return option;
}

/// Path tracing from the eye and from the lights. Eye paths are those of `path`; the vertices of
/// light paths are connected with the eye. Multiple importance sampling weighs what both find
/// (shared/light_path.h), so that the image has no bias, and the caustics of delta lights.
class Bidirectional : public Method {
public:
    explicit Bidirectional(RenderContext& context) : c_(context) {}

    void begin_frame(Budget& budget) override {
        photons_ = passes_ = 0;
        numbers_ = {};
        if (c_.on_device.plan.needs(Feature::caustics)) {
            // Not the image's own paths: weights that depend on them would bias it.
            RenderSettings other = c_.settings;
            other.seed = pcg4d({other.seed, 0xa13edu, 0, 0}).x;
            aim_at_casters(c_, sample_queries(c_.device, c_.on_device, c_.eye, other,
                                              c_.scene.cameras[c_.settings.camera]));
        }
        make_workspace();
        flux_unit_ = flux_unit_for(c_.on_device, most_photons_of_pass());
        c_.device.fill(workspace_->photons.flux_sums, 0);
        budget.start_pass();
    }

    std::uint64_t passes() const override { return split().count(); }
    std::uint64_t passes_per_seed() const override { return split().per_seed(); }

    bool pass(const Pass& pass, const OnProgress& on_part) override {
        const std::uint32_t samples = split().samples_of(pass.numbers.index);
        const auto first = static_cast<std::uint32_t>(split().first_sample(pass.numbers.index));
        // A light may be switched on while a shutter is open.
        const bool connects =
            c_.on_device.plan.needs(Feature::light_paths) && c_.on_device.record.light_count > 0;
        const std::uint64_t photons = connects ? photons_for(samples) : 0;
        const EyePass eye{.seed = pass.numbers.seed,
                          .first_sample = first,
                          .samples = samples,
                          .bounces = c_.settings.bounces,
                          .light_paths = static_cast<double>(photons) / samples};
        double done = 0;
        const bool finished =
            trace_eye_paths(c_.device, c_.on_device, c_.eye, eye, nullptr, [&](double share) {
                done = share;
                return on_part(photons > 0 ? share / 2 : share);
            });
        ++passes_;
        // Every pixel has as many samples as were finished, and light paths count for these.
        const auto counted = static_cast<std::uint32_t>(std::lround(done * samples));
        if (photons == 0 || counted == 0) {
            return finished;
        }
        PhotonPass emission = numbers_.next(pass.numbers.seed, photons);
        emission.bounces = c_.settings.bounces;
        trace_light_paths(
            c_.device, c_.on_device, *workspace_, c_.eye, emission, static_cast<float>(flux_unit_),
            {.photons = eye.light_paths, .last = first + samples, .finished = counted});
        photons_ += photons;
        return finished && on_part(1);
    }

    void persist(Archive& archive) override {
        archive.value(photons_);
        archive.value(passes_);
        archive.value(flux_unit_);
        numbers_.persist(archive);
        if (archive.loads()) {
            make_workspace();
        }
        persist_buffer(archive, c_.device, workspace_->photons.flux_sums,
                       flux_words * sizeof(std::int64_t));
    }

    void report(RenderStatistics& statistics) const override {
        statistics.photons_emitted = photons_;
        if (photons_ > 0) {
            statistics.flux = flux_of(
                download<std::int64_t>(c_.device, workspace_->photons.flux_sums, flux_words),
                flux_unit_ / static_cast<double>(passes_));
        }
    }

private:
    double pixels() const {
        return static_cast<double>(c_.settings.width) * static_cast<double>(c_.settings.height);
    }

    double photons_per_sample() const {
        return own_number(c_.settings, light_paths_option()) * pixels();
    }

    SamplePasses split() const {
        const double most = std::clamp(most_photons / std::max(photons_per_sample(), 1.0), 1.0,
                                       std::max(most_samples, eye_paths_of_small_image / pixels()));
        return sample_passes(c_.settings, static_cast<std::uint64_t>(most));
    }

    /// Photons of a pass with this number of samples of each pixel, if there is light.
    std::uint64_t photons_for(std::uint32_t samples) const {
        const double photons = std::ceil(photons_per_sample() * samples);
        return c_.settings.bounces == 0
                   ? 0
                   : static_cast<std::uint64_t>(std::min(photons, double(numbers_of_seed)));
    }

    std::uint64_t most_photons_of_pass() const { return photons_for(split().samples_of(0)); }

    void make_workspace() {
        if (!workspace_) {
            workspace_ = make_light_path_workspace(
                c_.device, std::max<std::uint64_t>(most_photons_of_pass(), 1));
        }
    }

    RenderContext& c_;
    std::optional<LightPathWorkspace> workspace_;
    PhotonNumbers numbers_;
    double flux_unit_ = 0;                   ///< of the fixed-point sums
    std::uint64_t photons_ = 0, passes_ = 0; ///< of the image so far
};

} // namespace

MethodInfo bidirectional_method() {
    return {.name = "bidirectional",
            .summary = "path tracing from the eye and from the lights, without bias",
            .paper = "Veach and Guibas 1995",
            .abilities = {.unbiased = true, .light_paths = true},
            .options = {with_sweep(samples_option(), {.quick = {"2", "32", "128"},
                                                      .full = {"1", "4", "16", "64", "256"}}),
                        bounces_option(), with_sweep(follow_roughness_option(), {}),
                        cull_back_faces_option(), aperture_option(), focus_option(),
                        light_paths_option()},
            .make = [](RenderContext& context) -> std::unique_ptr<Method> {
                return std::make_unique<Bidirectional>(context);
            }};
}

} // namespace argand
