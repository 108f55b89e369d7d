#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace argand {

/// What must be so after a frame, as far as it is given.
struct Expectation {
    std::optional<bool> moving;          ///< the frame is a preview
    std::optional<std::uint64_t> passes; ///< at least, of the picture at rest
    std::optional<double> seconds;       ///< at most, that the frame took
    std::optional<std::string> error;    ///< is part of the message of this event's changes
};

/// What happens at a frame: first changes, before it is rendered, in the order of these members;
/// then the picture is written and checked.
struct ScriptEvent {
    std::uint64_t frame = 0;
    std::optional<std::string> open; ///< a scene's file
    std::optional<std::string> method;
    std::vector<std::pair<std::string, std::string>> options; ///< of the method, and their values
    std::optional<std::pair<int, int>> size;
    std::optional<std::optional<double>> time;         ///< of animations; none: at rest
    std::optional<nlohmann::json> edits;               ///< a patch (View::edit())
    std::optional<std::string> screenshot, save_edits; ///< files to write
    std::optional<Expectation> expect;
};

/// A session of a view that nobody needs to watch.
struct Script {
    std::uint64_t frames = 0;        ///< at least one
    std::vector<ScriptEvent> events; ///< by rising frame
};

/// Reads a script (docs/view.md). source: of the text, for messages. Throws Error, which names the
/// event, on an unknown member, one of a wrong kind, or an event at a frame that there is not.
Script parse_script(const nlohmann::json& json, const std::string& source);

} // namespace argand
