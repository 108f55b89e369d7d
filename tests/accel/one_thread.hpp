#pragma once

#include "device_fixture.hpp"

#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

namespace argand {

/// Compares what lavapipe computes with its usual threads and with one. Other devices do not read
/// the number of threads.
class OneThreadTest : public DeviceTest {
protected:
    /// Open until open_with_one_thread() is called.
    static Device& open_with_all_threads() { return shared_devices.get({}); }

    /// lavapipe reads the number of threads when the first device of the process is opened, so this
    /// closes all others.
    Device& open_with_one_thread() {
        shared_devices.TearDown();
        const ScopedEnvironment threads("LP_NUM_THREADS", "1");
        Device& device = open_anew();
        if (device.info().driver.find("llvmpipe") != std::string::npos) {
            // A thread names itself once it runs, which takes a while on a busy machine.
            for (int wait = 0; wait < 1000 && lavapipe_threads() == 0; ++wait) {
                std::this_thread::sleep_for(std::chrono::milliseconds(10));
            }
            EXPECT_EQ(lavapipe_threads(), 1);
        }
        return device;
    }

private:
    static int lavapipe_threads() {
        int threads = 0;
        for (const auto& task : std::filesystem::directory_iterator("/proc/self/task")) {
            std::string name;
            std::getline(std::ifstream(task.path() / "comm") >> std::ws, name);
            threads += name.starts_with("llvmpipe-") ? 1 : 0;
        }
        return threads;
    }
};

} // namespace argand
