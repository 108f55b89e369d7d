#pragma once

#include "rendering.hpp"

namespace argand {

/// Throws UsageError on options that do not go with --frames.
void check_frames(const RenderOptions& options, const CLI::App& command);

/// The file of the first frame for an output's pattern.
std::string first_name(const RenderOptions& options, const std::string& pattern);

/// Renders the frames of --frames, each at its time. A frame's files appear only when the frame is
/// complete. --continue leaves out frames whose files exist. --json gets one line for each frame.
/// Throws Error if it is interrupted.
void render_frames(const RenderOptions& options, const CLI::App& command);

} // namespace argand
