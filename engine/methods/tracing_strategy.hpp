#pragma once

#include "base/archive.hpp"
#include "methods/method.hpp"
#include "photon/photon_map.hpp"

#include <glm/glm.hpp>
#include <span>

namespace argand {

/// How photons find their hits if not through the scene's tree; and rays of eye paths, if the
/// settings request that.
class TracingStrategy {
public:
    virtual ~TracingStrategy() = default;

    /// Makes ready for the photons of an image. queries: points in view.
    virtual void begin_frame(RenderContext& context, std::span<const glm::vec4> queries) = 0;

    /// Makes ready for the photons of a pass: the scene may have moved since the last one.
    virtual void follow(RenderContext& context) = 0;

    /// Saves or loads what the image depends on. Loading replaces begin_frame().
    virtual void persist(Archive& archive, RenderContext& context) = 0;

    /// Traces photons of the image. It refers to this and to the context.
    virtual PhotonTracer tracer(RenderContext& context) const = 0;

    /// Traces rays of the image's eye paths. They refer to this and to the context.
    virtual EyeTracers eye_tracers(RenderContext& context) const = 0;

    virtual void report(RenderStatistics& statistics) const = 0;
};

} // namespace argand
