#include "device/vulkan/vulkan_device.hpp"

#include "base/error.hpp"
#include "device/vulkan/result.hpp"
#include "kernels/indirect_groups.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

namespace argand::vulkan {

namespace {

constexpr std::size_t max_in_flight = 4;
constexpr std::uint32_t indirect_slots = 1024;
constexpr std::uint64_t indirect_slot_bytes = 16;
constexpr std::uint64_t inline_upload_bytes = 65536; // limit of vkCmdUpdateBuffer

VulkanBlock& vulkan(const Buffer& buffer) { return block_of<VulkanBlock>(buffer); }

std::uint64_t size_of(const BufferView& view) {
    return view.size > 0 ? view.size : view.buffer->size() - view.offset;
}

} // namespace

VulkanDevice::VulkanDevice(std::shared_ptr<Instance> instance, VkPhysicalDevice physical,
                           DeviceInfo info)
    : instance_(std::move(instance)), physical_(physical), info_(std::move(info)),
      device_(std::make_shared<LogicalDevice>()) {
    device_->instance = instance_;
    queue_family_ = compute_queue_family(physical_);
    const float priority = 1;
    VkDeviceQueueCreateInfo queue{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
    queue.queueFamilyIndex = queue_family_;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;

    std::vector<const char*> extensions;
    if (info_.features.push_descriptors) {
        extensions.push_back(VK_KHR_PUSH_DESCRIPTOR_EXTENSION_NAME);
    }
    const std::vector<std::string> offered = device_extensions(physical_);
    constexpr const char* portability =
        "VK_KHR_portability_subset"; // must be enabled where the device offers it
    if (std::find(offered.begin(), offered.end(), portability) != offered.end()) {
        extensions.push_back(portability);
    }
    VkPhysicalDeviceVulkan12Features features{
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES};
    features.shaderOutputLayer = info_.features.raster ? VK_TRUE : VK_FALSE;
    VkDeviceCreateInfo create{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO};
    create.pNext = &features;
    create.queueCreateInfoCount = 1;
    create.pQueueCreateInfos = &queue;
    create.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
    create.ppEnabledExtensionNames = extensions.data();
    const std::string doing = fmt::format("opening device '{}'", info_.name);
    check(vkCreateDevice(physical_, &create, nullptr, &device_->handle), doing);
    vkGetDeviceQueue(device_->handle, queue_family_, 0, &queue_);

    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(physical_, &properties);
    pipelines_ =
        std::make_unique<Pipelines>(device_->handle, info_.features.push_descriptors, properties);
    if (info_.features.raster) {
        raster_ = std::make_unique<VulkanRaster>(*this);
        work_ |= VK_PIPELINE_STAGE_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT;
    }

    timer_.emplace(device_->handle, info_.features.timestamps, properties.limits.timestampPeriod,
                   queue_families(physical_)[queue_family_].timestampValidBits);
}

VulkanDevice::~VulkanDevice() {
    vkDeviceWaitIdle(device_->handle);
    if (recording_) {
        destroy(*recording_);
    }
    for (Submission& submission : in_flight_) {
        destroy(submission);
    }
    for (Submission& submission : idle_) {
        destroy(submission);
    }
}

Submission VulkanDevice::make_submission() {
    Submission submission;
    VkCommandPoolCreateInfo pool{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    pool.queueFamilyIndex = queue_family_;
    check(vkCreateCommandPool(device_->handle, &pool, nullptr, &submission.command_pool),
          "creating a command pool");
    VkCommandBufferAllocateInfo allocate{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
    allocate.commandPool = submission.command_pool;
    allocate.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    allocate.commandBufferCount = 1;
    check(vkAllocateCommandBuffers(device_->handle, &allocate, &submission.commands),
          "allocating a command buffer");
    const VkFenceCreateInfo fence{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    check(vkCreateFence(device_->handle, &fence, nullptr, &submission.fence), "creating a fence");
    return submission;
}

void VulkanDevice::destroy(Submission& submission) {
    for (const VkDescriptorPool pool : submission.descriptor_pools) {
        vkDestroyDescriptorPool(device_->handle, pool, nullptr);
    }
    vkDestroyQueryPool(device_->handle, submission.queries.pool, nullptr);
    vkDestroyFence(device_->handle, submission.fence, nullptr);
    vkDestroyCommandPool(device_->handle, submission.command_pool, nullptr);
}

/// The current command buffer; starts one if there is none.
VkCommandBuffer VulkanDevice::commands() {
    if (recording_) {
        return recording_->commands;
    }
    if (idle_.empty()) {
        recording_ = make_submission();
    } else {
        recording_ = std::move(idle_.back());
        idle_.pop_back();
        check(vkResetCommandPool(device_->handle, recording_->command_pool, 0),
              "resetting a command pool");
        check(vkResetFences(device_->handle, 1, &recording_->fence), "resetting a fence");
    }
    VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    check(vkBeginCommandBuffer(recording_->commands, &begin), "recording commands");
    timer_->reset(recording_->queries, recording_->commands);
    if (timer_->open()) {
        timer_->stamp_begin(recording_->queries, recording_->commands);
    }
    return recording_->commands;
}

Buffer VulkanDevice::allocate(std::string name, std::uint64_t bytes) {
    check_allocation(info_, memory_->ledger(), name, bytes);
    Buffer buffer = allocate(std::move(name), bytes, MemoryKind::device);
    if (poisons_) {
        fill(buffer, undefined_word);
    }
    return buffer;
}

/// Commands keep their buffers, so free memory is used by none that is pending.
Buffer VulkanDevice::allocate(std::string name, std::uint64_t bytes, MemoryKind kind) {
    const auto allocate_one = [&](std::uint64_t size) {
        return allocate_block(physical_, device_, size, kind);
    };
    Buffer buffer(memory_->allocate(info_, std::move(name), bytes, allocate_one,
                                    static_cast<std::uint32_t>(kind)));
    vulkan(buffer).prepare(bytes);
    return buffer;
}

void VulkanDevice::barrier_for(std::span<const Use> uses) {
    const VkCommandBuffer recording = commands();
    if (std::any_of(uses.begin(), uses.end(), [&](const Use& use) {
            return hazards_.conflicts(*use.buffer->storage(), use.access);
        })) {
        VkMemoryBarrier barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER};
        barrier.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT;
        barrier.dstAccessMask = VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT |
                                VK_ACCESS_TRANSFER_READ_BIT | VK_ACCESS_TRANSFER_WRITE_BIT |
                                VK_ACCESS_INDIRECT_COMMAND_READ_BIT;
        // A separate pipeline stage reads indirect counts. The barrier includes it because the next
        // command may overwrite them.
        vkCmdPipelineBarrier(recording, work_ | VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT,
                             work_ | VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT, 0, 1, &barrier, 0,
                             nullptr, 0, nullptr);
        hazards_.barrier();
    }
    for (const Use& use : uses) {
        hazards_.record(*use.buffer->storage(), use.access);
        recording_->keep_alive.push_back(use.buffer->storage());
    }
}

/// Until the commands recorded now are complete.
void VulkanDevice::keep_alive(std::shared_ptr<const void> object) {
    commands();
    recording_->keep_alive.push_back(std::move(object));
}

void VulkanDevice::upload(const Buffer& to, std::uint64_t offset, std::span<const std::byte> data) {
    if (data.empty()) {
        return;
    }
    const Use use{&to, Access::write};
    if (data.size() <= inline_upload_bytes && data.size() % 4 == 0 && offset % 4 == 0) {
        barrier_for({&use, 1});
        vkCmdUpdateBuffer(commands(), vulkan(to).buffer, offset, data.size(), data.data());
        return;
    }
    const Buffer staging = allocate("upload staging", data.size(), MemoryKind::upload);
    std::memcpy(vulkan(staging).mapped, data.data(), data.size());
    barrier_for({&use, 1});
    const VkBufferCopy region{0, offset, data.size()};
    vkCmdCopyBuffer(commands(), vulkan(staging).buffer, vulkan(to).buffer, 1, &region);
    recording_->keep_alive.push_back(staging.storage());
}

void VulkanDevice::fill(const BufferView& to, std::uint32_t value) {
    const Use use{to.buffer, Access::write};
    const std::uint64_t bytes = size_of(to) & ~std::uint64_t(3);
    if (bytes > 0) {
        barrier_for({&use, 1});
        vkCmdFillBuffer(commands(), vulkan(*to.buffer).buffer, to.offset, bytes, value);
    }
}

void VulkanDevice::copy(const BufferView& from, const BufferView& to) {
    const std::array<Use, 2> uses{Use{from.buffer, Access::read}, Use{to.buffer, Access::write}};
    const VkBufferCopy region{from.offset, to.offset, std::min(size_of(from), size_of(to))};
    if (region.size > 0) {
        barrier_for(uses);
        vkCmdCopyBuffer(commands(), vulkan(*from.buffer).buffer, vulkan(*to.buffer).buffer, 1,
                        &region);
    }
}

VkDescriptorSet VulkanDevice::allocate_set(VkDescriptorSetLayout layout) {
    constexpr std::uint32_t sets_per_pool = 64;
    constexpr std::uint32_t texels_per_set = 4;
    if (recording_->descriptor_sets_left == 0) {
        const std::array<VkDescriptorPoolSize, 2> sizes{
            {{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, sets_per_pool * max_bindings},
             {VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, sets_per_pool * texels_per_set}}};
        VkDescriptorPoolCreateInfo create{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
        create.maxSets = sets_per_pool;
        create.poolSizeCount = sizes.size();
        create.pPoolSizes = sizes.data();
        VkDescriptorPool pool = VK_NULL_HANDLE;
        check(vkCreateDescriptorPool(device_->handle, &create, nullptr, &pool),
              "creating a descriptor pool");
        recording_->descriptor_pools.push_back(pool);
        recording_->descriptor_sets_left = sets_per_pool;
    }
    VkDescriptorSetAllocateInfo allocate{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
    allocate.descriptorPool = recording_->descriptor_pools.back();
    allocate.descriptorSetCount = 1;
    allocate.pSetLayouts = &layout;
    VkDescriptorSet set = VK_NULL_HANDLE;
    check(vkAllocateDescriptorSets(device_->handle, &allocate, &set),
          "allocating a descriptor set");
    --recording_->descriptor_sets_left;
    return set;
}

void VulkanDevice::bind(const KernelInfo& kernel, const KernelArguments& arguments) {
    if (kernel.uses_subgroups && !info_.features.subgroups) {
        fail("running kernel {}: it uses subgroups, which '{}' lacks or ARGAND_DISABLE turned off; "
             "please report this",
             kernel.name, info_.name);
    }
    if (arguments.buffer_count > info_.limits.storage_buffers ||
        kernel.local_size[0] * kernel.local_size[1] * kernel.local_size[2] >
            info_.limits.invocations) {
        fail("running kernel {}: it needs {} storage buffers and {} invocations per work-group, "
             "'{}' "
             "allows {} and {}; try "
             "another device with --device",
             kernel.name, arguments.buffer_count, kernel.local_size[0], info_.name,
             info_.limits.storage_buffers, info_.limits.invocations);
    }
    bind({.name = kernel.name,
          .bindings = kernel.bindings,
          .push_bytes = kernel.push_bytes,
          .pipeline = pipelines_->get(kernel, arguments),
          .point = VK_PIPELINE_BIND_POINT_COMPUTE,
          .stages = VK_SHADER_STAGE_COMPUTE_BIT},
         arguments);
}

void VulkanDevice::bind(const Bound& bound, const KernelArguments& arguments) {
    std::array<VkDescriptorBufferInfo, max_bindings> infos;
    std::array<VkBufferView, max_bindings> views;
    std::array<VkWriteDescriptorSet, max_bindings> writes;
    for (std::uint32_t i = 0; i < arguments.buffer_count; ++i) {
        const Buffer& buffer = *arguments.buffers[i];
        VulkanBlock& block = vulkan(buffer);
        // Not the whole block, which may be larger than the buffer.
        infos[i] = {block.buffer, arguments.offsets[i],
                    arguments.sizes[i] > 0 ? arguments.sizes[i]
                                           : padded_size(buffer.size()) - arguments.offsets[i]};
        writes[i] = {VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
        writes[i].dstBinding = i;
        writes[i].descriptorCount = 1;
        writes[i].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
        writes[i].pBufferInfo = &infos[i];
        if (bound.bindings[i].texels) {
            if (buffer.size() / 16 > info_.limits.texels) {
                fail("running kernel {}: '{}' has {} texels, '{}' allows {}; please report this",
                     bound.name, buffer.name(), buffer.size() / 16, info_.name,
                     info_.limits.texels);
            }
            views[i] = block.texels(arguments.offsets[i],
                                    arguments.sizes[i] > 0 ? arguments.sizes[i]
                                                           : buffer.size() - arguments.offsets[i]);
            writes[i].descriptorType = VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER;
            writes[i].pTexelBufferView = &views[i];
        }
    }
    const Pipeline& pipeline = bound.pipeline;
    const VkCommandBuffer recording = commands();
    vkCmdBindPipeline(recording, bound.point, pipeline.pipeline);
    if (info_.features.push_descriptors) {
        vkCmdPushDescriptorSetKHR(recording, bound.point, pipeline.layout, 0,
                                  arguments.buffer_count, writes.data());
    } else {
        const VkDescriptorSet set = allocate_set(pipeline.set_layout);
        for (std::uint32_t i = 0; i < arguments.buffer_count; ++i) {
            writes[i].dstSet = set;
        }
        vkUpdateDescriptorSets(device_->handle, arguments.buffer_count, writes.data(), 0, nullptr);
        vkCmdBindDescriptorSets(recording, bound.point, pipeline.layout, 0, 1, &set, 0, nullptr);
    }
    if (bound.push_bytes > 0) {
        vkCmdPushConstants(recording, pipeline.layout, bound.stages, 0, bound.push_bytes,
                           arguments.push.data());
    }
}

void VulkanDevice::dispatch(const KernelInfo& kernel, const KernelArguments& arguments,
                            std::uint64_t threads) {
    if (threads == 0) {
        return;
    }
    std::array<Use, max_bindings> uses;
    for (std::uint32_t i = 0; i < arguments.buffer_count; ++i) {
        uses[i] = {arguments.buffers[i], kernel.bindings[i].access};
    }
    barrier_for({uses.data(), arguments.buffer_count});
    bind(kernel, arguments);
    const std::uint64_t limit = info_.limits.groups;
    const std::uint64_t groups = (threads + kernel.local_size[0] - 1) / kernel.local_size[0];
    const std::uint64_t x = std::min(groups, limit);
    const std::uint64_t y = std::min((groups + x - 1) / x, limit);
    const std::uint64_t z = (groups + x * y - 1) / (x * y);
    vkCmdDispatch(commands(), static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y),
                  static_cast<std::uint32_t>(z));
}

void VulkanDevice::dispatch_indirect(const KernelInfo& kernel, const KernelArguments& arguments,
                                     const Buffer& counts, std::uint32_t count_index) {
    if (!group_counts_) {
        group_counts_ = allocate("indirect group counts", indirect_slots * indirect_slot_bytes);
    }
    const std::uint32_t slot = next_group_count_++ % indirect_slots;
    argand::dispatch(*this,
                     kernels::indirect_groups{.counts = counts,
                                              .groups = group_counts_,
                                              .params = {.count_index = count_index,
                                                         .group_size = kernel.local_size[0],
                                                         .slot = slot,
                                                         .group_limit = info_.limits.groups}},
                     1);
    std::array<Use, max_bindings + 1> uses;
    for (std::uint32_t i = 0; i < arguments.buffer_count; ++i) {
        uses[i] = {arguments.buffers[i], kernel.bindings[i].access};
    }
    uses[arguments.buffer_count] = {&group_counts_, Access::read};
    barrier_for({uses.data(), arguments.buffer_count + 1});
    bind(kernel, arguments);
    vkCmdDispatchIndirect(commands(), vulkan(group_counts_).buffer, slot * indirect_slot_bytes);
}

void VulkanDevice::finish_oldest() {
    Submission submission = std::move(in_flight_.front());
    in_flight_.pop_front();
    check(vkWaitForFences(device_->handle, 1, &submission.fence, VK_TRUE, UINT64_MAX),
          "waiting for the device");
    timer_->collect(submission.queries);
    submission.keep_alive.clear();
    for (const VkDescriptorPool pool : submission.descriptor_pools) {
        vkDestroyDescriptorPool(device_->handle, pool, nullptr);
    }
    submission.descriptor_pools.clear();
    submission.descriptor_sets_left = 0;
    idle_.push_back(std::move(submission));
}

void VulkanDevice::submit() {
    if (!recording_) {
        return;
    }
    if (timer_->open()) {
        timer_->stamp_end(recording_->queries, recording_->commands);
    }
    check(vkEndCommandBuffer(recording_->commands), "recording commands");
    VkSubmitInfo submit{VK_STRUCTURE_TYPE_SUBMIT_INFO};
    submit.commandBufferCount = 1;
    submit.pCommandBuffers = &recording_->commands;
    check(vkQueueSubmit(queue_, 1, &submit, recording_->fence), "submitting work to the device");
    in_flight_.push_back(std::move(*recording_));
    recording_.reset();
    while (in_flight_.size() > max_in_flight) {
        finish_oldest();
    }
}

void VulkanDevice::wait() {
    submit();
    while (!in_flight_.empty()) {
        finish_oldest();
    }
}

void VulkanDevice::download(const Buffer& from, std::uint64_t offset, std::span<std::byte> data) {
    if (data.empty()) {
        wait();
        return;
    }
    if (download_staging_.size() < data.size()) {
        wait();
        // Frames of a film fetch a little more or less each: that must not take new memory.
        constexpr std::size_t most_rounded = std::size_t{1} << 24;
        const std::size_t bytes =
            data.size() < most_rounded ? std::bit_ceil(data.size()) : data.size();
        download_staging_ = allocate("download staging", bytes, MemoryKind::download);
    }
    copy(BufferView(from, offset, data.size()), BufferView(download_staging_, 0, data.size()));
    VkMemoryBarrier barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER};
    barrier.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
    vkCmdPipelineBarrier(commands(), VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0,
                         1, &barrier, 0, nullptr, 0, nullptr);
    wait();
    std::memcpy(data.data(), vulkan(download_staging_).mapped, data.size());
}

void VulkanDevice::begin_stage(std::string_view name) {
    // A submission holds a fixed number of time stamps. Submit here, between stages, before they
    // run out.
    if (recording_ && recording_->queries.used + 2 > StageQueries::capacity) {
        submit();
    }
    commands();
    timer_->begin(name);
    timer_->stamp_begin(recording_->queries, recording_->commands);
}

void VulkanDevice::end_stage() {
    if (recording_) {
        timer_->stamp_end(recording_->queries, recording_->commands);
    }
    timer_->end();
}

std::vector<StageTime> VulkanDevice::stage_times() {
    wait();
    return timer_->times();
}

void VulkanDevice::reset_stage_times() {
    wait();
    timer_->clear();
}

std::vector<std::string> VulkanDevice::validation_messages() const {
    const std::lock_guard lock(instance_->validation().mutex);
    return instance_->validation().messages;
}

} // namespace argand::vulkan
