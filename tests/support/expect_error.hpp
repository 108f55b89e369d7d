#pragma once

#include "base/error.hpp"
#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>

namespace argand::testing {

/// The message of the Error that `act` throws. Fails the test if it throws none or the message has
/// several lines.
template <class Act> std::string error_of(Act&& act) {
    try {
        act();
    } catch (const Error& error) {
        const std::string message = error.what();
        EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 0) << message;
        EXPECT_FALSE(message.empty());
        return message;
    }
    ADD_FAILURE() << "no error was thrown";
    return "";
}

} // namespace argand::testing
