#include "methods/method_info.hpp"
#include "support/expect_error.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

namespace argand::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(MethodTable, UsersKnowTheBuiltInMethodsByTheseNames) {
    EXPECT_THAT(method_names(),
                ElementsAre("footprints", "photons", "knn", "progressive", "photon-queue",
                            "image-space", "path", "bidirectional"));
    EXPECT_EQ(RenderSettings().method, "footprints");
}

TEST(MethodTable, AnUnknownNameIsAnErrorThatListsTheKnownOnes) {
    EXPECT_EQ(builtin_methods().find("rays"), nullptr);
    const std::string message = error_of([] { builtin_methods().at("rays"); });
    EXPECT_THAT(message, HasSubstr("'rays'"));
    EXPECT_THAT(message, HasSubstr("footprints, photons, knn, progressive, photon-queue, "
                                   "image-space, path, bidirectional"));
}

TEST(MethodTable, EveryMethodDescribesItself) {
    for (const MethodInfo& method : builtin_methods()) {
        EXPECT_FALSE(method.summary.empty()) << method.name;
        EXPECT_FALSE(method.paper.empty()) << method.name;
        EXPECT_NE(method.make, nullptr) << method.name;
    }
}

TEST(MethodTable, AutotuningHasCandidatesAndAReference) {
    int first = 0;
    for (const MethodInfo& method : builtin_methods()) {
        first += method.trial == TrialOrder::first ? 1 : 0;
        if (method.trial != TrialOrder::never) {
            EXPECT_FALSE(method.abilities.unbiased) << method.name;
        }
    }
    EXPECT_EQ(first, 1);
    ASSERT_NE(builtin_methods().unbiased(), nullptr);
    EXPECT_EQ(builtin_methods().unbiased()->name, "path");
}

TEST(MethodTable, LawsFollowTheExponentWhereWidthsFallFromPassToPass) {
    RenderSettings settings;
    settings.progressive.exponent = 0.2;
    for (const MethodInfo& method : builtin_methods()) {
        for (const bool on : {false, true}) {
            settings.progressive.on = on;
            const bool falls = method.name == "progressive" || (on && method.abilities.photon_map);
            EXPECT_EQ(is_progressive(method, settings), falls) << method.name;
            const ErrorLaw law = law_of(method, settings);
            EXPECT_EQ(law.by_pass, falls) << method.name;
            EXPECT_EQ(law.noise_growth, falls ? 0.4 : method.law.noise_growth) << method.name;
            EXPECT_EQ(law.bias_fall, falls ? 0.4 : method.law.bias_fall) << method.name;
        }
    }
}

TEST(MethodTable, MethodsThatShareAnOptionAgreeOnIt) {
    for (const MethodInfo& method : builtin_methods()) {
        std::set<std::string> names;
        for (const Option& option : method.options) {
            EXPECT_TRUE(names.insert(option.name).second) << option.name;
        }
    }
    for (const Option* shared : builtin_methods().options()) {
        for (const MethodInfo& method : builtin_methods()) {
            if (const Option* option = method.option(shared->name)) {
                EXPECT_EQ(option->help, shared->help);
                EXPECT_EQ(option->kind, shared->kind);
                EXPECT_EQ(option->low, shared->low);
                EXPECT_EQ(option->high, shared->high);
                EXPECT_EQ(option->choices, shared->choices);
                EXPECT_EQ(option->report_key, shared->report_key);
                EXPECT_EQ(option->get(RenderSettings()), shared->get(RenderSettings()));
            }
        }
    }
}

TEST(MethodTable, SweptValuesAreValuesOfTheirOption) {
    for (const MethodInfo& method : builtin_methods()) {
        for (const Option& option : method.options) {
            for (const auto& values : {option.sweep.quick, option.sweep.full}) {
                for (const std::string& value : values) {
                    SCOPED_TRACE(method.name + " --" + option.name + " " + value);
                    RenderSettings settings;
                    option.set(settings, value);
                    EXPECT_EQ(option.get(settings), value);
                    if (option.kind == OptionKind::choice) {
                        EXPECT_THAT(option.choices, ::testing::Contains(value));
                    } else if (option.kind != OptionKind::flag) {
                        EXPECT_GE(std::stod(value), option.low);
                        EXPECT_LE(std::stod(value), option.high);
                    }
                }
            }
        }
    }
}

TEST(Option, WhatTheMethodChoosesCanBeAskedFor) {
    for (const MethodInfo& method : builtin_methods()) {
        for (const Option& option : method.options) {
            RenderSettings settings;
            if (option.get(settings) == "auto") {
                SCOPED_TRACE(method.name + " --" + option.name);
                option.set(settings,
                           option.choices.empty() ? value_text(option.low) : option.choices.back());
                EXPECT_NE(option.get(settings), "auto");
                option.set(settings, "auto");
                EXPECT_EQ(option.get(settings), "auto");
            }
        }
    }
}

TEST(Option, OnesOfAMethodAloneAreKeptByName) {
    const Option option = own_option("echoes", "How many", OptionKind::integer, "3");
    RenderSettings settings;
    EXPECT_EQ(own_number(settings, option), 3);
    option.set(settings, "5");
    EXPECT_EQ(option.get(settings), "5");
    EXPECT_EQ(own_number(settings, option), 5);
}

TEST(Option, TextsThatAreNoValuesAreErrors) {
    RenderSettings settings;
    const MethodInfo& footprints = builtin_methods().at("footprints");
    for (const auto& [name, text] : {std::pair{"spp", "many"}, std::pair{"spp", "-1"},
                                     std::pair{"flatness", "1x"}, std::pair{"wide-codes", "yes"}}) {
        const std::string message =
            error_of([&, n = name, t = text] { footprints.option(n)->set(settings, t); });
        EXPECT_THAT(message, HasSubstr(std::string("--") + name));
    }
    footprints.option("radius")->set(settings, "0.5");
    EXPECT_EQ(settings.radius, 0.5);
    footprints.option("radius")->set(settings, "auto");
    EXPECT_FALSE(settings.radius);
}

} // namespace
} // namespace argand::testing
