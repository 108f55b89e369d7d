#pragma once

#include "device/device.hpp"
#include "device/hazards.hpp"
#include "device/vulkan/instance.hpp"
#include "device/vulkan/memory.hpp"
#include "device/vulkan/pipelines.hpp"
#include "device/vulkan/stage_timer.hpp"
#include "device/vulkan/vulkan_raster.hpp"

#include <deque>
#include <memory>
#include <optional>

namespace argand::vulkan {

/// Submitted commands, with the objects that must live until they are complete.
struct Submission {
    VkCommandPool command_pool = VK_NULL_HANDLE;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    VkFence fence = VK_NULL_HANDLE;
    std::vector<VkDescriptorPool> descriptor_pools;
    std::uint32_t descriptor_sets_left = 0;
    StageQueries queries;
    std::vector<std::shared_ptr<const void>> keep_alive;
};

/// What binding arguments needs to know of a kernel or a raster program.
struct Bound {
    const char* name;
    std::span<const KernelBinding> bindings;
    std::uint32_t push_bytes;
    const Pipeline& pipeline;
    VkPipelineBindPoint point;
    VkShaderStageFlags stages;
};

class VulkanDevice final : public Device {
public:
    VulkanDevice(std::shared_ptr<Instance> instance, VkPhysicalDevice physical, DeviceInfo info);
    ~VulkanDevice() override;

    const DeviceInfo& info() const override { return info_; }
    Buffer allocate(std::string name, std::uint64_t bytes) override;
    void upload(const Buffer& to, std::uint64_t offset, std::span<const std::byte> data) override;
    void fill(const BufferView& to, std::uint32_t value) override;
    void copy(const BufferView& from, const BufferView& to) override;
    void dispatch(const KernelInfo& kernel, const KernelArguments& arguments,
                  std::uint64_t threads) override;
    void dispatch_indirect(const KernelInfo& kernel, const KernelArguments& arguments,
                           const Buffer& counts, std::uint32_t count_index) override;
    Raster* raster() override { return raster_.get(); }
    void submit() override;
    void wait() override;
    void download(const Buffer& from, std::uint64_t offset, std::span<std::byte> data) override;
    void begin_stage(std::string_view name) override;
    void end_stage() override;
    std::vector<StageTime> stage_times() override;
    void reset_stage_times() override;
    const std::map<std::string, MemoryUse>& memory_by_name() const override {
        return memory_->ledger().by_name;
    }
    MemoryUse memory() const override { return memory_->ledger().total; }
    BlockUse blocks() const override { return memory_->blocks(); }
    std::vector<std::string> validation_messages() const override;

private:
    friend class VulkanRaster;

    struct Use {
        const Buffer* buffer;
        Access access;
    };

    Submission make_submission();
    void destroy(Submission& submission);
    VkCommandBuffer commands();
    void barrier_for(std::span<const Use> uses);
    void keep_alive(std::shared_ptr<const void> object);
    void bind(const KernelInfo& kernel, const KernelArguments& arguments);
    void bind(const Bound& bound, const KernelArguments& arguments);
    VkDescriptorSet allocate_set(VkDescriptorSetLayout layout);
    Buffer allocate(std::string name, std::uint64_t bytes, MemoryKind kind);
    void finish_oldest();

    std::shared_ptr<Instance> instance_;
    VkPhysicalDevice physical_;
    DeviceInfo info_;
    std::shared_ptr<DeviceMemory> memory_ = std::make_shared<DeviceMemory>();
    bool poisons_ = poisons_memory();
    std::shared_ptr<LogicalDevice> device_;
    std::uint32_t queue_family_ = 0;
    VkQueue queue_ = VK_NULL_HANDLE;
    std::unique_ptr<Pipelines> pipelines_;
    std::unique_ptr<VulkanRaster> raster_; ///< null: the device has no rasteriser
    VkPipelineStageFlags work_ = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT |
                                 VK_PIPELINE_STAGE_TRANSFER_BIT; ///< that uses buffers
    std::optional<StageTimer> timer_;
    HazardTracker hazards_;
    std::optional<Submission> recording_;
    std::deque<Submission> in_flight_;
    std::vector<Submission> idle_;
    Buffer group_counts_; ///< ring of indirect group counts
    std::uint32_t next_group_count_ = 0;
    Buffer download_staging_;
};

/// Vulkan's devices, in Vulkan's order.
std::vector<DeviceInfo> list_devices();

/// Opens the device at info.index of list_devices().
std::unique_ptr<Device> open(DeviceInfo info);

} // namespace argand::vulkan
