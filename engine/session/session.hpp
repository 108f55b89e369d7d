#pragma once

#include "base/on_progress.hpp"
#include "methods/film_variance.hpp"
#include "methods/method.hpp"
#include "methods/render_result.hpp"
#include "session/streams.hpp"

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace argand {

class World;

/// A request for one more pass.
struct PassPlan {
    /// Passes of the whole image, as far as is known: bandwidths follow from it.
    double expected = 1;
    /// Passes of different streams have independent noise. The first pass must be of stream 0.
    std::uint32_t stream = 0;
    bool keeps_width = false; ///< see Pass
};

/// A method at work on the images of a scene, one after the other. It owns what outlives a pass
/// (film, random streams, budget) and an image (the method with its memory).
class Session {
public:
    /// Keeps references to the world and the scene. Throws UsageError on an unknown method.
    Session(World& world, const Scene& scene, const RenderSettings& settings,
            MethodTable methods = builtin_methods());
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    /// Begins an image of the scene as it is now, and as World::update() has been told. Its bits do
    /// not depend on the images before it, unless the method keeps photons, or centers of cube maps
    /// (--choose-every). seed: replaces that of
    /// the settings. Call it before the first pass. Throws Error if the device cannot do it.
    void begin_frame(std::uint32_t seed);

    /// Whether the image is complete and shows the scene as it is now, after World::update(), with
    /// this seed: begin_frame() would lead to the same image.
    bool is_current(std::uint32_t seed) const;

    /// Follows the scene to another moment within the same image, after World::update(). What was
    /// learnt for the image stays. A saved state does not hold the moment: follow again after
    /// resume().
    void follow();

    /// Goes on with the image of a session for the same scene, settings and device, from what its
    /// save() returned: later passes have the bits that they would have had there. Replaces
    /// begin_frame(). Throws Error on other bytes, after which the session has no image.
    void resume(std::span<const std::uint8_t> state, std::uint32_t seed);

    /// All that later passes of the image depend on. Not after an interrupted pass, which is not
    /// whole. Waits for the device.
    std::vector<std::uint8_t> save();

    // The following need an image: begin_frame() or resume().

    /// The next pass of the image that the settings request, with their photons, samples and
    /// budget. None: the image is complete.
    std::optional<PassPlan> next_pass();

    /// Adds a pass to the image. on_part: told the share of this pass. Returns false if on_part
    /// did; the image then holds the samples that were finished, maybe none.
    bool step(const PassPlan& plan, const OnProgress& on_part);

    /// Passes of the image so far.
    std::uint64_t passes() const { return statistics_.passes; }
    /// The share of the image that is done, with `part` of the next pass.
    double share(double part) const;
    /// A few words on the image so far for those who watch, or none.
    std::string describe() const;
    /// The image so far, as in RenderResult. Waits for the device.
    std::vector<Layer> layers();
    /// The image so far, and what happened. Waits for the device.
    RenderResult result();

private:
    CameraRecord camera(const DeviceScene& on_device) const;
    void prepare(std::uint32_t seed);
    void persist(Archive& archive);

    World& world_;
    const Scene& scene_;
    RenderSettings settings_;
    MethodTable methods_;
    std::optional<RenderContext> context_; ///< empty before the first image
    std::unique_ptr<Method> method_;
    /// What the image shows, beside the settings.
    struct Shown {
        std::uint64_t revision = 0; ///< of the world
        std::vector<Light> lights;
        std::optional<glm::vec3> sky;
        std::optional<Environment> environment;
        Camera camera;
        bool operator==(const Shown&) const = default;
    };
    Shown now() const;
    std::optional<Shown> complete_; ///< empty before the image is complete
    bool followed_ = false;         ///< whether the image shows several moments
    Budget budget_;
    Streams streams_;
    RenderStatistics statistics_;
    FilmVariance variance_; ///< if the settings ask for it
};

} // namespace argand
