#pragma once

#include "rendering.hpp"

namespace argand {

/// Throws UsageError on options that do not go with --frames.
void check_frames(const RenderOptions& options, const CLI::App& command);

/// Throws now what writing an output (a picture, a pattern of pictures, a film) would throw after
/// hours: UsageError if it has the wrong extension, Error if it cannot be written.
void check_output(const RenderOptions& options, const std::string& output);

/// Renders the frames of --frames, each at its time. A frame's files appear only when the frame is
/// complete, a film when all are. --continue leaves out frames whose files exist. --json gets one
/// line for each frame. Throws Error if it is interrupted.
void render_frames(const RenderOptions& options, const CLI::App& command);

} // namespace argand
