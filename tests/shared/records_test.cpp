// Records go from host to device as bytes, so std430, C++ and CUDA must agree on their layout.
#include "shared/camera.h"
#include "shared/light_record.h"
#include "shared/material_record.h"
#include "shared/scene_records.h"

#include <cstddef>
#include <gtest/gtest.h>
#include <type_traits>

namespace argand {
namespace {

template <class T>
constexpr bool is_plain = std::is_trivially_copyable_v<T>&& std::is_standard_layout_v<T>;

TEST(Records, MaterialLiesInLanesOf16Bytes) {
    EXPECT_TRUE(is_plain<MaterialRecord>);
    EXPECT_EQ(sizeof(MaterialRecord), 160u);
    EXPECT_EQ(offsetof(MaterialRecord, coat), 96u);
    EXPECT_EQ(offsetof(MaterialRecord, absorption_r), 80u);
    EXPECT_EQ(offsetof(MaterialRecord, specular_r), 16u);
    EXPECT_EQ(offsetof(MaterialRecord, emission_r), 32u);
    EXPECT_EQ(offsetof(MaterialRecord, double_sided), 44u);
    EXPECT_EQ(offsetof(MaterialRecord, roughness), 48u);
    EXPECT_EQ(offsetof(MaterialRecord, coverage), 64u);
    EXPECT_EQ(offsetof(MaterialRecord, exponent), 68u);
}

TEST(Records, LightLiesInLanesOf16Bytes) {
    EXPECT_TRUE(is_plain<LightRecord>);
    EXPECT_EQ(sizeof(LightRecord), 64u);
    EXPECT_EQ(offsetof(LightRecord, kind), 12u);
    EXPECT_EQ(offsetof(LightRecord, r), 16u);
    EXPECT_EQ(offsetof(LightRecord, dx), 32u);
    EXPECT_EQ(offsetof(LightRecord, ex), 48u);
    EXPECT_EQ(offsetof(LightRecord, triangle_and_sides), 60u);
}

TEST(Records, SceneLiesInLanesOf16Bytes) {
    EXPECT_TRUE(is_plain<SceneRecord>);
    EXPECT_EQ(sizeof(SceneRecord), 832u);
    EXPECT_EQ(offsetof(SceneRecord, target_0), 64u);
    EXPECT_EQ(offsetof(SceneRecord, view), 160u);
    EXPECT_EQ(offsetof(SceneRecord, close_lights), 176u);
    EXPECT_EQ(offsetof(SceneRecord, close_reaches), 688u);
    EXPECT_EQ(offsetof(SceneRecord, close_light_count), 816u);
}

TEST(Records, CameraLiesInLanesOf16Bytes) {
    EXPECT_TRUE(is_plain<CameraRecord>);
    EXPECT_EQ(sizeof(CameraRecord), 64u);
    EXPECT_EQ(offsetof(CameraRecord, forward_x), 16u);
    EXPECT_EQ(offsetof(CameraRecord, across_x), 32u);
    EXPECT_EQ(offsetof(CameraRecord, down_x), 48u);
}

} // namespace
} // namespace argand
