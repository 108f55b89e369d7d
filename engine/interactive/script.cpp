#include "interactive/script.hpp"

#include "base/json_members.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace argand {

namespace {

using nlohmann::json;

/// An event's members, or those of what it expects.
class Event : public JsonMembers {
public:
    using JsonMembers::JsonMembers;

    /// The member of that name, which must be a T where there is one.
    template <class T>
    std::optional<T> get(const char* key, bool (json::*is)() const noexcept, const char* expected) {
        const json* member = find(key);
        if (!member) {
            return {};
        }
        if (!(member->*is)()) {
            complain(key, expected);
        }
        return member->get<T>();
    }

    std::optional<std::string> text(const char* key) {
        return get<std::string>(key, &json::is_string, "a text");
    }
    std::optional<std::uint64_t> count(const char* key) {
        const json* member = find(key);
        if (!member) {
            return {};
        }
        if (!member->is_number_integer() || *member < 0) {
            complain(key, "a number 0, 1, 2, ...");
        }
        return member->get<std::uint64_t>();
    }
};

std::optional<std::pair<int, int>> read_size(Event& event) {
    const json* member = event.find("size");
    if (!member) {
        return {};
    }
    const auto is_side = [](const json& side) {
        return side.is_number_integer() && side >= 1 && side <= 32'768;
    };
    if (!member->is_array() || member->size() != 2 || !is_side((*member)[0]) ||
        !is_side((*member)[1])) {
        event.complain("size", "two numbers from 1 to 32768, such as [640, 480]");
    }
    return std::pair((*member)[0].get<int>(), (*member)[1].get<int>());
}

std::optional<std::optional<double>> read_time(Event& event) {
    const json* member = event.find("time");
    if (!member) {
        return {};
    }
    if (member->is_null()) {
        return std::optional<double>();
    }
    if (!member->is_number() || !(std::abs(member->get<double>()) <= 1e9)) {
        event.complain("time", "a number of seconds from -1e9 to 1e9, or null");
    }
    return std::optional(member->get<double>());
}

std::vector<std::pair<std::string, std::string>> read_options(Event& event) {
    std::vector<std::pair<std::string, std::string>> options;
    if (const json* member = event.find("options")) {
        if (!member->is_object()) {
            event.complain("options", "an object of values by option");
        }
        for (const auto& [name, value] : member->items()) {
            if (value.is_object() || value.is_array() || value.is_null()) {
                event.complain("options", "an object of texts, numbers, true and false");
            }
            options.emplace_back(name, value.is_string()    ? value.get<std::string>()
                                       : value.is_boolean() ? (value.get<bool>() ? "on" : "off")
                                                            : value.dump());
        }
    }
    return options;
}

std::optional<Expectation> read_expectation(Event& event, const std::string& where) {
    const json* member = event.find("expect");
    if (!member) {
        return {};
    }
    Event expected(*member, "'expect' of " + where, event.doing());
    Expectation result;
    result.moving = expected.get<bool>("moving", &json::is_boolean, "true or false");
    result.passes = expected.count("passes");
    result.seconds = expected.get<double>("seconds", &json::is_number, "a number");
    result.error = expected.text("error");
    expected.end();
    return result;
}

ScriptEvent read_event(const json& object, std::size_t index, std::uint64_t frames,
                       const std::string& doing) {
    const std::string where = fmt::format("event {}", index);
    Event event(object, where, doing);
    ScriptEvent read;
    const std::optional<std::uint64_t> frame = event.count("frame");
    if (!frame || *frame >= frames) {
        event.complain("frame", fmt::format("a number from 0 to {}", frames - 1));
    }
    read.frame = *frame;
    read.open = event.text("open");
    read.method = event.text("method");
    read.options = read_options(event);
    read.size = read_size(event);
    read.time = read_time(event);
    read.edits = event.get<json>("edits", &json::is_object, "an object of edits");
    read.screenshot = event.text("screenshot");
    read.save_edits = event.text("save_edits");
    read.expect = read_expectation(event, where);
    event.end();
    return read;
}

} // namespace

Script parse_script(const nlohmann::json& json, const std::string& source) {
    Event all(json, "the text", fmt::format("reading script '{}'", source));
    Script script;
    script.frames = all.count("frames").value_or(0);
    if (script.frames == 0) {
        all.complain("frames", "a number of frames, at least 1");
    }
    if (const nlohmann::json* events = all.find("events")) {
        if (!events->is_array()) {
            all.complain("events", "a list of events");
        }
        for (std::size_t i = 0; i < events->size(); ++i) {
            script.events.push_back(read_event((*events)[i], i, script.frames, all.doing()));
        }
    }
    all.end();
    std::stable_sort(script.events.begin(), script.events.end(),
                     [](const ScriptEvent& a, const ScriptEvent& b) { return a.frame < b.frame; });
    return script;
}

} // namespace argand
