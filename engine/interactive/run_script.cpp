#include "interactive/run_script.hpp"

#include "base/error.hpp"
#include "base/json.hpp"

#include <algorithm>

namespace argand {

namespace {

/// Makes the changes. Returns what was wrong with the first one that is refused, after which there
/// are no more; empty: nothing.
std::string change(View& view, const ScriptEvent& event) {
    try {
        if (event.open) {
            view.open(*event.open);
        }
        if (event.method) {
            view.set_method(*event.method);
        }
        for (const auto& [name, value] : event.options) {
            view.set_option(name, value);
        }
        if (event.size) {
            view.resize(event.size->first, event.size->second);
        }
        if (event.time) {
            view.set_time(*event.time);
        }
        if (event.edits) {
            view.edit(*event.edits);
        }
    } catch (const DeviceFault&) {
        throw;
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

/// Renders a frame: if what is asked for cannot be rendered, one of what was there before.
ViewFrame render(View& view, std::string& failure) {
    try {
        return view.frame();
    } catch (const DeviceFault&) {
        throw;
    } catch (const Error& error) {
        failure = error.what();
        return view.frame();
    }
}

void check(const Expectation& expected, const ViewFrame& frame) {
    if (expected.moving && *expected.moving != frame.moving) {
        fail("running a script: frame {} shows {}, but the script expects otherwise", frame.number,
             frame.moving ? "a preview" : "the picture at rest");
    }
    if (expected.passes && frame.passes < *expected.passes) {
        fail("running a script: after frame {} the picture has {} passes; the script expects {}",
             frame.number, frame.passes, *expected.passes);
    }
    if (expected.seconds && frame.seconds > *expected.seconds) {
        fail("running a script: frame {} took {:.3g} s; the script allows {:.3g} s", frame.number,
             frame.seconds, *expected.seconds);
    }
}

void check_error(const ScriptEvent& event, const std::string& error) {
    const std::string expected =
        event.expect && event.expect->error ? *event.expect->error : std::string();
    if (!error.empty() && (expected.empty() || error.find(expected) == std::string::npos)) {
        fail("running a script: at frame {}, {}", event.frame, error);
    }
    if (error.empty() && !expected.empty()) {
        fail("running a script: at frame {} the script expects the error '{}', but there is none",
             event.frame, expected);
    }
}

} // namespace

void run_script(View& view, const Script& script, const ScriptCalls& calls) {
    auto next = script.events.begin();
    for (std::uint64_t number = 0; number < script.frames && !calls.stops(); ++number) {
        const auto first = next;
        std::vector<std::string> errors;
        for (; next != script.events.end() && next->frame == number; ++next) {
            errors.push_back(change(view, *next));
        }
        std::string failure;
        const ViewFrame frame = render(view, failure);
        if (!failure.empty() && errors.empty()) {
            fail("running a script: at frame {}, {}", number, failure);
        }
        if (!failure.empty() && errors.back().empty()) {
            errors.back() = failure;
        }
        const auto refused = std::find_if(errors.begin(), errors.end(),
                                          [](const std::string& error) { return !error.empty(); });
        calls.on_frame(frame, refused == errors.end() ? "" : *refused);
        for (auto event = first; event != next; ++event) {
            check_error(*event, errors[static_cast<std::size_t>(event - first)]);
            if (event->screenshot) {
                calls.screenshot(view, *event->screenshot);
            }
            if (event->save_edits) {
                write_json(*event->save_edits, view.edits());
            }
            if (event->expect) {
                check(*event->expect, frame);
            }
        }
    }
}

} // namespace argand
