#include "methods/method.hpp"
#include "methods/render_options.hpp"

#include <algorithm>

namespace argand {

namespace {

/// Path tracing with next-event estimation, multiple importance sampling (Veach and Guibas 1995)
/// and Russian roulette. It has no bias: the reference for all other methods.
class PathTracing : public Method {
public:
    explicit PathTracing(RenderContext& context) : c_(context) {}

    std::uint64_t passes() const override {
        return (samples() + samples_of_pass() - 1) / samples_of_pass();
    }

    bool pass(const Pass& pass, const OnProgress& on_part) override {
        const std::uint64_t round = pass.numbers.index / passes();
        const std::uint64_t in_round = pass.numbers.index % passes() * samples_of_pass();
        const EyePass eye{.seed = pass.numbers.seed,
                          .first_sample = static_cast<std::uint32_t>(round * samples() + in_round),
                          .samples = static_cast<std::uint32_t>(
                              std::min(samples_of_pass(), samples() - in_round)),
                          .bounces = c_.settings.bounces};
        return trace_eye_paths(c_.device, c_.on_device, c_.eye, eye, nullptr, on_part);
    }

    std::uint64_t passes_per_seed() const override {
        return numbers_of_seed / samples() * passes();
    }

    void persist(Archive&) override {}
    void report(RenderStatistics&) const override {}

private:
    std::uint64_t samples() const { return std::max(c_.settings.samples, 1u); }
    /// Of all passes but a last, smaller one.
    std::uint64_t samples_of_pass() const {
        const std::uint64_t spread =
            std::max<std::uint64_t>(samples() / std::max(c_.settings.least_passes, 1u), 1);
        return std::min<std::uint64_t>(spread, std::max(c_.settings.samples_per_pass, 1u));
    }

    RenderContext& c_;
};

} // namespace

MethodInfo path_method() {
    return {.name = "path",
            .summary = "path tracing without bias, the reference for the others",
            .paper = "Veach and Guibas 1995",
            .abilities = {.unbiased = true},
            .options = {with_sweep(samples_option(), {.quick = {"2", "32", "128"},
                                                      .full = {"1", "4", "16", "64", "256"}}),
                        bounces_option(), with_sweep(follow_roughness_option(), {}),
                        cull_back_faces_option(), aperture_option(), focus_option(),
                        filter_option(), deterministic_option()},
            .make = [](RenderContext& context) -> std::unique_ptr<Method> {
                return std::make_unique<PathTracing>(context);
            }};
}

} // namespace argand
