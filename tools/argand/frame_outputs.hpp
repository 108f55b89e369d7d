#pragma once

#include "film_writer.hpp"
#include "picture_size.hpp"
#include "rendering.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace argand {

/// Where the frames of a render go: to pictures, several for each frame, and to films.
class FrameOutputs {
public:
    /// Starts the films. Throws as FilmWriter does.
    explicit FrameOutputs(const RenderOptions& options);

    bool has_films() const { return !films_.empty(); }

    /// The files of a frame, films included.
    std::vector<std::string> names(std::uint64_t frame) const;
    /// The same for the user, to whom films say which frame it is.
    std::vector<std::string> names_to_tell(std::uint64_t frame) const;

    /// Whether all pictures of a frame are there. One that cannot be read does not count: it is
    /// empty, or was cut short. Throws Error if one has another size.
    bool has(std::uint64_t frame) const;

    /// Writes a frame. Throws Error if it cannot be written.
    void write(RenderJob& job, const Rendered& rendered, std::uint64_t frame);

    /// Completes the films. Throws as FilmWriter does.
    void finish();

private:
    std::vector<std::string> outputs_;
    PictureSize size_; ///< of the part that is rendered
    std::vector<std::unique_ptr<FilmWriter>> films_;
};

} // namespace argand
