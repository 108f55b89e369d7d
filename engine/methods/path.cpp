#include "methods/method.hpp"
#include "methods/render_options.hpp"
#include "methods/sample_passes.hpp"

namespace argand {

namespace {

/// Path tracing with next-event estimation, multiple importance sampling (Veach and Guibas 1995)
/// and Russian roulette. It has no bias: the reference for all other methods.
class PathTracing : public Method {
public:
    explicit PathTracing(RenderContext& context) : c_(context) {}

    std::uint64_t passes() const override { return split().count(); }

    bool pass(const Pass& pass, const OnProgress& on_part) override {
        const EyePass eye{.seed = pass.numbers.seed,
                          .first_sample =
                              static_cast<std::uint32_t>(split().first_sample(pass.numbers.index)),
                          .samples = split().samples_of(pass.numbers.index),
                          .bounces = c_.settings.bounces};
        return trace_eye_paths(c_.device, c_.on_device, c_.eye, eye, nullptr, on_part);
    }

    std::uint64_t passes_per_seed() const override { return split().per_seed(); }

    void persist(Archive&) override {}
    void report(RenderStatistics&) const override {}

private:
    SamplePasses split() const { return sample_passes(c_.settings, numbers_of_seed); }

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
