#pragma once

#include "methods/render_result.hpp"
#include "methods/render_settings.hpp"
#include "plan/plan.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace argand {

/// What an option takes on the command line; a flag takes nothing.
enum class OptionKind : std::uint8_t { flag, integer, number, choice };

/// One option changed in a scene's base settings, for a sweep to try.
struct Variation {
    const Scene& scene;
    const Plan& plan; ///< of the scene for a method that uses everything there is
    const RenderSettings& base;
    const RenderSettings& changed;
};

/// The values that `argand tradeoff` tries.
struct OptionSweep {
    std::vector<std::string> quick, full; ///< by `--quick` and without
    /// The value to try at `factor` times the one that the method chose (`learnt`); empty if it
    /// chose none. A sweep tries half of it and twice. Null: the method chooses none.
    std::function<std::string(const RenderStatistics& learnt, double factor)> around;
    /// Whether the variation can change the picture; a sweep leaves out what cannot. Null: always.
    std::function<bool(const Variation& variation)> matters;
};

/// An option of `argand render` by which a method's picture is decided. Values are texts, as on the
/// command line; those of a flag are "on" and "off". Options of one name are the same option,
/// whichever method lists them; only what a sweep tries may differ.
struct Option {
    std::string name; ///< without the dashes: "query-cell"
    std::string help; ///< one sentence without a full stop
    OptionKind kind = OptionKind::flag;
    double low = 0, high = 0;         ///< range of an integer or a number
    std::vector<std::string> choices; ///< of a choice
    /// Key among the parameters of `argand render --json`.
    std::string report_key;
    /// The option keeps bandwidths from shrinking from pass to pass, so that the error of a long
    /// render does not fall as the method's ErrorLaw says.
    bool fixes_bandwidth = false;
    /// Passes do not depend on the option, only how many there are: a saved render may go on with
    /// another value.
    bool ends_render = false;
    /// The value in these settings; "auto": the method chooses.
    std::function<std::string(const RenderSettings&)> get;
    /// Throws UsageError if the text is no value of this option's type. Ranges are the command
    /// line's to check.
    std::function<void(RenderSettings&, const std::string&)> set;
    OptionSweep sweep;
};

/// An option that has no member of its own in RenderSettings, but is kept in `own` there: for the
/// options that one method declares for itself.
Option own_option(const std::string& name, const std::string& help, OptionKind kind,
                  const std::string& initially);

/// The value of such an option, which must be a number.
double own_number(const RenderSettings& settings, const Option& option);

/// Values as texts and back. read_value throws UsageError, which names the option.
std::string value_text(bool value);
std::string value_text(std::uint32_t value);
std::string value_text(std::uint64_t value);
std::string value_text(float value);
std::string value_text(double value);
template <class T> std::string value_text(const std::optional<T>& value) {
    return value ? value_text(*value) : "auto";
}
void read_value(const std::string& option, const std::string& text, bool& value);
void read_value(const std::string& option, const std::string& text, std::uint32_t& value);
void read_value(const std::string& option, const std::string& text, std::uint64_t& value);
void read_value(const std::string& option, const std::string& text, float& value);
void read_value(const std::string& option, const std::string& text, double& value);
template <class T>
void read_value(const std::string& option, const std::string& text, std::optional<T>& value) {
    if (text == "auto") {
        value.reset();
    } else {
        read_value(option, text, value.emplace());
    }
}

/// "query-cell" as a key of JSON: "query_cell".
std::string key_of(std::string name);

/// An option whose value is a member of RenderSettings: `member` returns a reference to it. Its
/// kind follows from the member's type.
template <class Member>
Option member_option(const std::string& name, const std::string& help, Member member,
                     double low = 0, double high = 0) {
    using Value = std::remove_reference_t<std::invoke_result_t<Member, RenderSettings&>>;
    constexpr bool integral =
        std::is_integral_v<Value> || std::is_same_v<Value, std::optional<std::uint32_t>>;
    return {.name = name,
            .help = help,
            .kind = std::is_same_v<Value, bool> ? OptionKind::flag
                    : integral                  ? OptionKind::integer
                                                : OptionKind::number,
            .low = low,
            .high = high,
            .choices = {},
            .report_key = key_of(name),
            .get =
                [member](const RenderSettings& settings) {
                    RenderSettings copy = settings;
                    return value_text(member(copy));
                },
            .set = [member,
                    name](RenderSettings& settings,
                          const std::string& text) { read_value(name, text, member(settings)); },
            .sweep = {}};
}

/// The same option with other values to sweep.
Option with_sweep(Option option, OptionSweep sweep);

} // namespace argand
