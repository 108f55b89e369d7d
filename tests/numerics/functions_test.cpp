// The shared maths in single precision, on host and device, compared with the same code in double
// precision.
#include "device_fixture.hpp"
#include "functions.h"
#include "kernels/evaluate_codes.hpp"
#include "kernels/evaluate_lights.hpp"
#include "kernels/evaluate_maths.hpp"
#include "kernels/evaluate_scatter.hpp"
#include "results.hpp"
#include "table.hpp"

#include <bit>
#include <fmt/ranges.h>
#include <iterator>

namespace argand::testing {
namespace {

/// Largest value of each measure over all cases, and the case in which the bounded measure is
/// largest.
struct Worst {
    double ulp = 0;
    double relative = 0;
    double conditioned = 0;
    double bounded = 0; ///< ulp or conditioned, depending on Function::measure
    std::size_t at = 0;
    std::size_t wrong_at = 0;
    int wrong_decisions = 0; ///< decisions that rounding of the inputs does not explain
    int borderline = 0;      ///< decisions that rounding of the inputs explains
};

constexpr double smallest_normal = 0x1p-126; // devices may flush smaller numbers

struct Part {
    int first = 0;
    int size = 1;
    bool decision = false;
    bool cell = false;
};

std::vector<Part> parts_of(const Function& f) {
    std::vector<Part> parts;
    int first = 0;
    for (const char* c = f.parts; *c != 0; ++c) {
        const bool whole = *c == 'd' || *c == 'c';
        const int size = whole ? 1 : *c - '0';
        parts.push_back({first, size, whole, *c == 'c'});
        first += size;
    }
    return parts;
}

template <class A, class B> double distance(const A& a, const B& b, const Part& part) {
    double sum = 0;
    for (int k = part.first; k < part.first + part.size; ++k) {
        const double difference = double(a[k]) - double(b[k]);
        sum += difference * difference;
    }
    return std::sqrt(sum);
}

double size_of(const truth::Outputs& y, const Part& part) {
    return distance(y, truth::Outputs{}, part);
}

double unit_in_the_last_place(double size) {
    int exponent = 0;
    std::frexp(std::max(size, smallest_normal), &exponent);
    return std::ldexp(1.0, exponent - 24);
}

template <class A>
bool same_decisions(const A& a, const truth::Outputs& b, const std::vector<Part>& parts) {
    return std::all_of(parts.begin(), parts.end(), [&](const Part& p) {
        return !p.decision || double(a[p.first]) == b[static_cast<std::size_t>(p.first)];
    });
}

/// Whether at most cells differ, each by at most one.
template <class A>
bool are_neighbours(const A& a, const truth::Outputs& b, const std::vector<Part>& parts) {
    return std::all_of(parts.begin(), parts.end(), [&](const Part& p) {
        return !p.decision || std::abs(double(a[p.first]) - b[static_cast<std::size_t>(p.first)]) <=
                                  (p.cell ? 1 : 0);
    });
}

truth::Inputs nudged(const Function& f, truth::Inputs x, std::mt19937& bits, int most) {
    for (int k = 0; k < f.rounded; ++k) {
        float& value = x[static_cast<std::size_t>(k)];
        const float towards = bits() % 2 == 0 ? HUGE_VALF : -HUGE_VALF;
        for (int step = static_cast<int>(bits() % static_cast<unsigned>(most + 1)); step > 0;
             --step) {
            value = std::nextafter(value, towards);
        }
    }
    return x;
}

/// Whether inputs a few units in the last place away lead to the same decisions in double
/// precision, or to both lower and higher ones.
template <class A>
bool is_borderline(const Function& f, const truth::Inputs& x, const A& decided,
                   const std::vector<Part>& parts) {
    std::mt19937 bits(7);
    std::vector<double> low(parts.size(), HUGE_VAL);
    std::vector<double> high(parts.size(), -HUGE_VAL);
    for (int i = 0; i < 4000; ++i) {
        const truth::Outputs y = truth::evaluate(f.id, nudged(f, x, bits, 8));
        bool within = true;
        for (std::size_t p = 0; p < parts.size(); ++p) {
            if (parts[p].decision) {
                const double decision = y[static_cast<std::size_t>(parts[p].first)];
                low[p] = std::min(low[p], decision);
                high[p] = std::max(high[p], decision);
                const auto mine = double(decided[parts[p].first]);
                within = within && low[p] <= mine && mine <= high[p];
            }
        }
        if (within) {
            return true;
        }
    }
    return false;
}

/// Change of each part of the result, to first order, if every input is off by half a unit in the
/// last place. stable: whether most nearby inputs lead to the same decisions.
std::vector<double> conditions(const Function& f, const truth::Inputs& x, const truth::Outputs& y,
                               const std::vector<Part>& parts, bool& stable) {
    int same = 0;
    std::vector<double> sums(parts.size(), 0.0);
    for (int k = 0; k < f.rounded; ++k) {
        std::vector<double> largest(parts.size(), 0.0);
        for (const float towards : {HUGE_VALF, -HUGE_VALF}) {
            truth::Inputs moved = x;
            float& value = moved[static_cast<std::size_t>(k)];
            value = std::nextafter(value, towards);
            const truth::Outputs changed = truth::evaluate(f.id, moved);
            if (!same_decisions(changed, y, parts)) {
                continue;
            }
            for (std::size_t p = 0; p < parts.size(); ++p) {
                const double change = 0.5 * distance(changed, y, parts[p]);
                largest[p] = std::isfinite(change) ? std::max(largest[p], change) : largest[p];
            }
        }
        for (std::size_t p = 0; p < parts.size(); ++p) {
            sums[p] += largest[p];
        }
    }
    // If a single changed input changes a decision, several changed inputs may not.
    std::mt19937 bits(9);
    for (int i = 0; i < 32; ++i) {
        const truth::Outputs changed = truth::evaluate(f.id, nudged(f, x, bits, 1));
        if (!same_decisions(changed, y, parts)) {
            continue;
        }
        ++same;
        for (std::size_t p = 0; p < parts.size(); ++p) {
            const double change = 0.5 * distance(changed, y, parts[p]);
            sums[p] = std::isfinite(change) ? std::max(sums[p], change) : sums[p];
        }
    }
    stable = same >= 24;
    return sums;
}

struct Case {
    truth::Inputs x;
    truth::Outputs y;
    std::vector<double> condition;
    bool stable = true; ///< most nearby inputs lead to the same decisions
};

void take(Worst& worst, const Function& f, const std::vector<Part>& parts, const Case& c,
          const Values& found, std::size_t index) {
    if (!same_decisions(found.y, c.y, parts)) {
        const bool excused =
            are_neighbours(found.y, c.y, parts) || is_borderline(f, c.x, found.y, parts);
        worst.borderline += excused;
        worst.wrong_decisions += !excused;
        worst.wrong_at = excused ? worst.wrong_at : index;
        return;
    }
    if (!c.stable) {
        ++worst.borderline;
        return;
    }
    for (std::size_t p = 0; p < parts.size(); ++p) {
        if (parts[p].decision) {
            continue;
        }
        const double size = size_of(c.y, parts[p]);
        double error = distance(found.y, c.y, parts[p]);
        error = std::isfinite(error) ? error : std::numeric_limits<double>::infinity();
        const double unit = unit_in_the_last_place(size);
        const double ulp = error / unit;
        const double conditioned = error / (unit / 2 + c.condition[p]);
        worst.ulp = std::max(worst.ulp, ulp);
        worst.relative = std::max(worst.relative, error / std::max(size, smallest_normal));
        worst.conditioned = std::max(worst.conditioned, conditioned);
        const double bounded = f.measure == Measure::ulp ? ulp : conditioned;
        if (bounded > worst.bounded) {
            worst.bounded = bounded;
            worst.at = index;
        }
    }
}

std::string inputs_in_words(const Function& f, const Case& c, std::size_t index) {
    if (f.rounded == 0 || f.rounded > 7) {
        return fmt::format("case {}", index);
    }
    std::string text;
    for (int k = 0; k < f.rounded; ++k) {
        text += fmt::format("{}{:.9g}", k > 0 ? ", " : "", c.x[static_cast<std::size_t>(k)]);
    }
    return text;
}

std::string in_full(const Function& f, const Case& c, const Values& found) {
    return fmt::format("inputs {}\ntruth {}\nfound {}\nrounding the inputs changes {}, of {}",
                       fmt::join(c.x, " "), fmt::join(c.y, " "), fmt::join(found.y, " "),
                       fmt::join(c.condition, " "), f.parts);
}

class NumericsTable : public DeviceTest {
protected:
    void SetUp() override {
        if (!runs(kernels::evaluate_maths::info)) {
            GTEST_SKIP() << "evaluate_maths has no twin";
        }
    }

    std::vector<Values> on_device(Device& device, const Function& f,
                                  const std::vector<Arguments>& inputs) {
        const Buffer in = upload(device, "inputs", inputs);
        const Buffer out = device.allocate("outputs", inputs.size() * sizeof(Values));
        const Buffer which = upload(device, "which", std::vector<std::uint32_t>{f.id});
        if (f.id < end_of_maths) {
            dispatch(device, kernels::evaluate_maths{.inputs = in, .outputs = out, .which = which},
                     inputs.size());
        } else if (f.id < end_of_scatter) {
            dispatch(device,
                     kernels::evaluate_scatter{.inputs = in, .outputs = out, .which = which},
                     inputs.size());
        } else if (f.id < end_of_lights) {
            dispatch(device, kernels::evaluate_lights{.inputs = in, .outputs = out, .which = which},
                     inputs.size());
        } else {
            dispatch(device, kernels::evaluate_codes{.inputs = in, .outputs = out, .which = which},
                     inputs.size());
        }
        return download<Values>(device, out, inputs.size());
    }

    void check(Device& device, const Function& f, std::size_t count) {
        SCOPED_TRACE(f.name);
        const std::vector<Part> parts = parts_of(f);
        Draw draw(f.id);
        std::vector<Case> cases(count);
        std::vector<Arguments> inputs(count);
        for (std::size_t i = 0; i < count; ++i) {
            draw.x = {};
            draw.next = 0;
            f.draw(draw);
            cases[i].x = draw.x;
            cases[i].y = truth::evaluate(f.id, draw.x);
            cases[i].condition = f.measure == Measure::conditioned
                                     ? conditions(f, draw.x, cases[i].y, parts, cases[i].stable)
                                     : std::vector<double>(parts.size(), 0.0);
            inputs[i] = std::bit_cast<Arguments>(draw.x);
        }
        const std::vector<Values> values = on_device(device, f, inputs);
        Worst host;
        Worst other;
        std::size_t unequal = 0;
        std::size_t first_unequal = count;
        for (std::size_t i = 0; i < count; ++i) {
            const Values mine = evaluate(f.id, inputs[i]);
            take(host, f, parts, cases[i], mine, i);
            take(other, f, parts, cases[i], values[i], i);
            // Compares values, so zeros of different signs are equal.
            const bool same =
                std::equal(std::begin(mine.y), std::end(mine.y), std::begin(values[i].y));
            unequal += !same;
            first_unequal = same ? first_unequal : std::min(first_unequal, i);
        }
        for (const auto& [where, worst] : {std::pair("host", host), std::pair("device", other)}) {
            const auto show = [&, on_host = where == std::string("host")](std::size_t i) {
                return in_full(f, cases[i], on_host ? evaluate(f.id, inputs[i]) : values[i]);
            };
            EXPECT_LE(worst.bounded, f.bound) << where << "\n" << show(worst.at);
            EXPECT_EQ(worst.wrong_decisions, 0) << where << "\n" << show(worst.wrong_at);
            EXPECT_LE(worst.borderline, static_cast<int>(f.borderline * static_cast<double>(count)))
                << where;
        }
        // lavapipe rounds every division and square root correctly, like the host.
        const bool exact = device.info().driver.find("llvmpipe") != std::string::npos;
        if (exact) {
            EXPECT_EQ(unequal, 0u)
                << in_full(f, cases[first_unequal % count], values[first_unequal % count])
                << "\non the host "
                << fmt::format("{}",
                               fmt::join(evaluate(f.id, inputs[first_unequal % count]).y, " "));
        }
        record_result(
            "functions",
            {{"name", f.name},
             {"inputs", f.inputs},
             {"measure", f.measure == Measure::ulp ? "ulp" : "conditioned"},
             {"cases", count},
             {"host_ulp", host.ulp},
             {"device_ulp", other.ulp},
             {"relative", std::max(host.relative, other.relative)},
             {"conditioned", f.measure == Measure::ulp
                                 ? nlohmann::json()
                                 : nlohmann::json(std::max(host.conditioned, other.conditioned))},
             {"bound", f.bound},
             {"borderline", std::max(host.borderline, other.borderline)},
             {"most_borderline", f.borderline},
             {"unequal", unequal},
             {"decides_only", std::string(f.parts).find_first_not_of("cd") == std::string::npos},
             {"at", inputs_in_words(f, cases[host.at], host.at)}});
    }

    void check_all(std::size_t count) {
        Device& device = open();
        std::vector<Function> table = maths_table();
        for (std::vector<Function> part : {scatter_table(), light_table(), codes_table()}) {
            std::move(part.begin(), part.end(), std::back_inserter(table));
        }
        record_result("devices", device.info().name + ", " + device.info().driver);
        for (const Function& f : table) {
            check(device, f, count);
        }
    }
};

TEST_F(NumericsTable, FunctionsStayWithinTheirBounds) { check_all(4'000); }

TEST_F(NumericsTable, SlowFunctionsStayWithinTheirBoundsOverManyInputs) {
    // The document has more.
    check_all(environment("ARGAND_NUMERICS_RESULTS").empty() ? 15'000 : 40'000);
}

} // namespace
} // namespace argand::testing
