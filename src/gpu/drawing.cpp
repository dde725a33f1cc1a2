// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "gpu/drawing.hpp"

#include "shaders/raster.vert.h"

namespace impinge::gpu {
namespace {

enum Binding : std::uint32_t { kInput, kRuns, kOutput };

VkShaderModule load(Device& device, std::span<const std::uint32_t> spirv) {
  const VkShaderModuleCreateInfo code{
      .sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO, .codeSize = spirv.size_bytes(), .pCode = spirv.data()};
  VkShaderModule module = VK_NULL_HANDLE;
  check(vkCreateShaderModule(device.handle(), &code, nullptr, &module), "loading a shader");
  return module;
}

}  // namespace

Drawing::Drawing(Device& device, std::span<const std::uint32_t> fragment_spirv, VkDescriptorType input)
    : device_(device), input_(input) {
  try {
    make_layout();
    make_target();
    make_pipeline(fragment_spirv);
  } catch (...) {
    release();
    throw;
  }
}

Drawing::~Drawing() { release(); }

void Drawing::release() {
  vkDestroyPipeline(device_.handle(), pipeline_, nullptr);
  vkDestroyFramebuffer(device_.handle(), target_, nullptr);
  vkDestroyRenderPass(device_.handle(), pass_, nullptr);
  vkDestroyPipelineLayout(device_.handle(), pipeline_layout_, nullptr);
  vkDestroyDescriptorSetLayout(device_.handle(), set_layout_, nullptr);
}

void Drawing::make_layout() {
  constexpr VkShaderStageFlags kFragment = VK_SHADER_STAGE_FRAGMENT_BIT;
  const VkDescriptorSetLayoutBinding bindings[] = {
      {.binding = kInput, .descriptorType = input_, .descriptorCount = 1, .stageFlags = kFragment},
      {.binding = kRuns,
       .descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
       .descriptorCount = 1,
       .stageFlags = VK_SHADER_STAGE_VERTEX_BIT | kFragment},
      {.binding = kOutput,
       .descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
       .descriptorCount = 1,
       .stageFlags = kFragment}};
  const VkDescriptorSetLayoutCreateInfo set{
      .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO, .bindingCount = 3, .pBindings = bindings};
  check(vkCreateDescriptorSetLayout(device_.handle(), &set, nullptr, &set_layout_), "laying out a shader's buffers");
  const VkPipelineLayoutCreateInfo layout{
      .sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO, .setLayoutCount = 1, .pSetLayouts = &set_layout_};
  check(vkCreatePipelineLayout(device_.handle(), &layout, nullptr, &pipeline_layout_), "laying out a shader");
}

void Drawing::make_target() {
  const VkSubpassDescription subpass{.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS};
  const VkRenderPassCreateInfo pass{
      .sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO, .subpassCount = 1, .pSubpasses = &subpass};
  check(vkCreateRenderPass(device_.handle(), &pass, nullptr, &pass_), "making what is drawn to");
  // Every device allows 4096 by 4096.
  const VkFramebufferCreateInfo target{.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO,
                                       .renderPass = pass_,
                                       .width = kRasterWidth,
                                       .height = kRasterHeight,
                                       .layers = 1};
  check(vkCreateFramebuffer(device_.handle(), &target, nullptr, &target_), "making what is drawn to");
}

void Drawing::make_pipeline(std::span<const std::uint32_t> fragment_spirv) {
  VkShaderModule vertex = VK_NULL_HANDLE, fragment = VK_NULL_HANDLE;
  const auto unload = [&] {
    vkDestroyShaderModule(device_.handle(), vertex, nullptr);
    vkDestroyShaderModule(device_.handle(), fragment, nullptr);
  };
  try {
    vertex = load(device_, shader_raster_vert), fragment = load(device_, fragment_spirv);
    const VkPipelineShaderStageCreateInfo stages[] = {{.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                                                       .stage = VK_SHADER_STAGE_VERTEX_BIT,
                                                       .module = vertex,
                                                       .pName = "main"},
                                                      {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                                                       .stage = VK_SHADER_STAGE_FRAGMENT_BIT,
                                                       .module = fragment,
                                                       .pName = "main"}};
    const VkPipelineVertexInputStateCreateInfo input{.sType =
                                                         VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
    const VkPipelineInputAssemblyStateCreateInfo assembly{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO,
        .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP};
    const VkViewport whole{0, 0, kRasterWidth, kRasterHeight, 0, 1};
    const VkRect2D all{{0, 0}, {kRasterWidth, kRasterHeight}};
    const VkPipelineViewportStateCreateInfo viewport{.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO,
                                                     .viewportCount = 1,
                                                     .pViewports = &whole,
                                                     .scissorCount = 1,
                                                     .pScissors = &all};
    const VkPipelineRasterizationStateCreateInfo rasterization{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO,
        .polygonMode = VK_POLYGON_MODE_FILL,
        .cullMode = VK_CULL_MODE_NONE,
        .lineWidth = 1};
    const VkPipelineMultisampleStateCreateInfo samples{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
        .rasterizationSamples = VK_SAMPLE_COUNT_1_BIT};
    const VkGraphicsPipelineCreateInfo pipeline{.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
                                                .stageCount = 2,
                                                .pStages = stages,
                                                .pVertexInputState = &input,
                                                .pInputAssemblyState = &assembly,
                                                .pViewportState = &viewport,
                                                .pRasterizationState = &rasterization,
                                                .pMultisampleState = &samples,
                                                .layout = pipeline_layout_,
                                                .renderPass = pass_};
    check(vkCreateGraphicsPipelines(device_.handle(), VK_NULL_HANDLE, 1, &pipeline, nullptr, &pipeline_),
          "compiling a shader");
  } catch (...) {
    unload();
    throw;
  }
  unload();
}

void Drawing::draw(VkCommandBuffer commands, VkDescriptorSet set, std::uint32_t runs, VkQueryPool query) const {
  const VkRenderPassBeginInfo begin{.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO,
                                    .renderPass = pass_,
                                    .framebuffer = target_,
                                    .renderArea = {{0, 0}, {kRasterWidth, kRasterHeight}}};
  if (query != VK_NULL_HANDLE) vkCmdResetQueryPool(commands, query, 0, 1);
  vkCmdBeginRenderPass(commands, &begin, VK_SUBPASS_CONTENTS_INLINE);
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_);
  vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_layout_, 0, 1, &set, 0, nullptr);
  if (query != VK_NULL_HANDLE) vkCmdBeginQuery(commands, query, 0, 0);
  vkCmdDraw(commands, 4, runs, 0, 0);
  if (query != VK_NULL_HANDLE) vkCmdEndQuery(commands, query, 0);
  vkCmdEndRenderPass(commands);
}

DrawingBindings::DrawingBindings(const Drawing& drawing) : device_(drawing.device()) {
  const bool is_image = drawing.input() == VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE;
  const VkDescriptorPoolSize sizes[] = {
      {.type = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, .descriptorCount = is_image ? 2u : 3u},
      {.type = VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, .descriptorCount = 1}};
  const VkDescriptorPoolCreateInfo pool{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                        .maxSets = 1,
                                        .poolSizeCount = is_image ? 2u : 1u,
                                        .pPoolSizes = sizes};
  check(vkCreateDescriptorPool(device_.handle(), &pool, nullptr, &pool_), "making room for a shader's buffers");
  VkDescriptorSetLayout layout = drawing.layout();
  const VkDescriptorSetAllocateInfo set{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                        .descriptorPool = pool_,
                                        .descriptorSetCount = 1,
                                        .pSetLayouts = &layout};
  if (const VkResult result = vkAllocateDescriptorSets(device_.handle(), &set, &set_); result < 0) {
    vkDestroyDescriptorPool(device_.handle(), pool_, nullptr);
    check(result, "making room for a shader's buffers");
  }
}

DrawingBindings::DrawingBindings(const Drawing& drawing, const Image& input, const Buffer& runs, const Buffer& output)
    : DrawingBindings(drawing) {
  const VkDescriptorImageInfo info{.imageView = input.view(), .imageLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
  const VkWriteDescriptorSet write_image{.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                                         .dstSet = set_,
                                         .dstBinding = kInput,
                                         .descriptorCount = 1,
                                         .descriptorType = VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE,
                                         .pImageInfo = &info};
  vkUpdateDescriptorSets(device_.handle(), 1, &write_image, 0, nullptr);
  write(kRuns, runs), write(kOutput, output);
}

DrawingBindings::DrawingBindings(const Drawing& drawing, const Buffer& input, const Buffer& runs, const Buffer& output)
    : DrawingBindings(drawing) {
  write(kInput, input), write(kRuns, runs), write(kOutput, output);
}

DrawingBindings::~DrawingBindings() { vkDestroyDescriptorPool(device_.handle(), pool_, nullptr); }

void DrawingBindings::write(std::uint32_t binding, const Buffer& buffer) {
  const VkDescriptorBufferInfo info{.buffer = buffer.handle(), .offset = 0, .range = buffer.bytes()};
  const VkWriteDescriptorSet write{.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                                   .dstSet = set_,
                                   .dstBinding = binding,
                                   .descriptorCount = 1,
                                   .descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                                   .pBufferInfo = &info};
  vkUpdateDescriptorSets(device_.handle(), 1, &write, 0, nullptr);
}

}  // namespace impinge::gpu
