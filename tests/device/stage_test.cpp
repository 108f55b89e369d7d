#include "device_fixture.hpp"
#include "kernels/mark_threads.hpp"

namespace argand {
namespace {

class Stages : public DeviceTest {
protected:
    void SetUp() override {
        if (!runs(kernels::mark_threads::info)) {
            GTEST_SKIP() << "mark_threads has no twin";
        }
    }
    static void work(Device& device, const Buffer& buffer) {
        dispatch(device, kernels::mark_threads{.visits = buffer}, buffer.size() / 4);
    }
};

TEST_F(Stages, TimesAreNamedInTheOrderOfFirstUseAndAddUp) {
    Device& device = open_anew();
    const Buffer buffer = upload(device, "words", std::vector<std::uint32_t>(1 << 20, 0));
    for (int i = 0; i < 3; ++i) {
        for (const char* name : {"emit", "trace", "emit"}) {
            const StageScope stage(device, name);
            work(device, buffer);
        }
    }
    const std::vector<StageTime> times = device.stage_times();
    ASSERT_EQ(times.size(), 2u);
    EXPECT_EQ(times[0].name, "emit");
    EXPECT_EQ(times[0].runs, 6u);
    EXPECT_EQ(times[1].name, "trace");
    EXPECT_EQ(times[1].runs, 3u);
    for (const StageTime& time : times) {
        EXPECT_GE(time.seconds, 0);
        EXPECT_LT(time.seconds, 60);
    }
    if (device.info().features.timestamps) {
        EXPECT_GT(times[0].seconds, 0);
    }
    device.reset_stage_times();
    EXPECT_TRUE(device.stage_times().empty());
}

TEST_F(Stages, MaySpanSubmissions) {
    Device& device = open_anew();
    const Buffer buffer = upload(device, "words", std::vector<std::uint32_t>(1 << 18, 0));
    {
        const StageScope stage(device, "long");
        for (int i = 0; i < 3; ++i) {
            work(device, buffer);
            device.submit();
        }
    }
    const std::vector<StageTime> times = device.stage_times();
    ASSERT_EQ(times.size(), 1u);
    EXPECT_EQ(times[0].runs, 1u);
    EXPECT_GE(times[0].seconds, 0);
}

TEST_F(Stages, MayExceedTheTimeStampsOfASubmission) {
    Device& device = open_anew();
    const Buffer buffer = upload(device, "words", std::vector<std::uint32_t>(64, 0));
    for (int i = 0; i < 1000; ++i) {
        const StageScope stage(device, "short");
        work(device, buffer);
    }
    ASSERT_EQ(device.stage_times().size(), 1u);
    EXPECT_EQ(device.stage_times()[0].runs, 1000u);
    EXPECT_EQ(download<std::uint32_t>(device, buffer, 64), std::vector<std::uint32_t>(64, 1000));
}

TEST_F(Stages, WithoutTimeStampsTimesAreZero) {
    Device& device = open_anew({"", "timestamps", ""});
    const Buffer buffer = upload(device, "words", std::vector<std::uint32_t>(64, 0));
    {
        const StageScope stage(device, "untimed");
        work(device, buffer);
    }
    const std::vector<StageTime> times = device.stage_times();
    ASSERT_EQ(times.size(), 1u);
    EXPECT_EQ(times[0].seconds, 0);
    EXPECT_EQ(times[0].runs, 1u);
}

} // namespace
} // namespace argand
