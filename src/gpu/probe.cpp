// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "gpu/probe.hpp"

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "gpu/kernel.hpp"
#include "shaders/probe.comp.h"
#include "shaders/probe_doubles.comp.h"

namespace impinge::gpu {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
/// More than is lost where a factor of at most 64 meets a number below 2^-126 that is taken for zero.
constexpr double kLost = 0x1p-119;

/// Whether x is the exact number or one of its two neighbours, or both are next to nothing.
bool is_faithful(float x, double exact) {
  if (std::abs(double{x} - exact) <= kLost) return true;
  return double{std::nextafter(x, -kInfinity)} < exact && exact < double{std::nextafter(x, kInfinity)};
}

/// Whether x is what comes of rounding the product first.
bool is_unfused(float x, double product, float c) {
  const float nearest = static_cast<float>(product);
  for (const float rounded : {std::nextafter(nearest, -kInfinity), nearest, std::nextafter(nearest, kInfinity)})
    if (is_faithful(rounded, product) && is_faithful(x, double{rounded} - double{c})) return true;
  return false;
}

std::string told(const char* what, float a, float b) {
  char text[96];
  std::snprintf(text, sizeof text, "its %s of %a and %a is not rounded as IEEE 754 asks", what, double{a}, double{b});
  return text;
}

/// Empty: as it should be. All exact values below fit in a double: factors have 24 bits, terms are within 2^26 of each
/// other where both count.
std::string judge(const ProbeCase& of, const ProbeAnswer& answer) {
  const float a = of.x[0], b = of.x[1];
  const double x = a, y = b, c = of.x[2], d = of.x[3];
  if (!is_faithful(answer.x[0], x + y)) return told("sum", a, b);
  if (!is_faithful(answer.x[1], x - y)) return told("difference", a, b);
  if (!is_faithful(answer.x[2], x * y)) return told("product", a, b);
  if (!is_unfused(answer.x[3], x * y, of.x[2])) return "it fuses a product and a difference that it may not fuse";
  // With the bounds of shaders/two_floats.glsl.
  if (std::abs((double{answer.x[4]} - (x + y)) + double{answer.x[5]}) > 0x1p-45 * std::abs(x + y) + kLost)
    return "it loses what a sum of two floats leaves over";
  const bool are_small_parts = std::abs(c) <= 0x1p-23 * std::abs(x) && std::abs(d) <= 0x1p-23 * std::abs(y);
  if (are_small_parts && std::abs((double{answer.x[6]} - (x + c) * (y + d)) + double{answer.x[7]}) >
                             0x1p-40 * (std::abs(x * y) + std::abs(x * d) + std::abs(c * y)) + 4 * kLost)
    return "it loses what a product of two floats leaves over";
  const bool is_near_nothing = std::abs(x) < 0x1p-125 && std::abs(y) < 0x1p-125;
  if (std::abs(double{answer.x[8]} - std::max(x, y)) > kLost) return "its maximum is wrong";
  if (std::abs(double{answer.x[9]} - std::abs(x)) > kLost) return "its absolute value is wrong";
  if ((answer.above != 0) != (a > b) && !is_near_nothing) return "its comparison is wrong";
  const int sign = x > std::abs(y) ? 1 : x < -std::abs(y) ? -1 : 0;
  if (answer.sign != sign && !is_near_nothing) return "its comparison with a bound is wrong";
  return {};
}

}  // namespace

std::vector<ProbeCase> probe_cases() {
  std::vector<ProbeCase> cases;
  const auto add = [&](float a, float b) {
    // c is the product as it is rounded here, so that a fused difference leaves what was rounded off; where c and d are
    // the small parts of two numbers, they are below 2^-23 of the large ones.
    const float product = a * b;
    cases.push_back({{a, b, product, 0}});
    cases.push_back({{a, b, a * 0x1.8p-25f, b * -0x1.4p-25f}});
  };
  std::mt19937 random(1);
  const auto mantissa = [&] { return 1 + static_cast<float>(random() >> 9) * 0x1p-23f; };
  const auto sign = [&] { return (random() & 1) != 0 ? 1.0f : -1.0f; };
  for (int i = 0; i < 3000; ++i)
    add(sign() * std::ldexp(mantissa(), static_cast<int>(random() % 25) - 12), sign() * mantissa());
  // Halfway between two floats, and next to it; and what nearly cancels.
  for (const float one : {1.0f, 1 + 0x1p-23f, 2 - 0x1p-23f, 1.5f}) {
    for (const float other : {0x1p-24f, 0x1.000002p-24f, 0x1.fffffep-25f, 0x1p-23f, 0x1.8p-23f, 0x1p-25f, 1 - 0x1p-24f})
      for (const float s : {1.0f, -1.0f}) add(one, s * other), add(s * other, one);
    for (const float other : {1.0f, 1 - 0x1p-24f, 1 + 0x1p-23f, 0.5f, 2.0f}) add(one, -other), add(-other, one);
  }
  // Where floats end: denormal operands and results.
  for (const float small : {0x1p-149f, 0x1p-140f, 0x1.8p-127f, 0x1p-126f, 0x1.000002p-126f, 0.0f})
    for (const float other : {0x1p-149f, 0x1.4p-126f, 0x1p-100f, 0x1.8p-30f, 1.0f, 48.0f})
      for (const float s : {1.0f, -1.0f}) cases.push_back({{small, s * other, small * other * s, 0}});
  cases.resize((cases.size() + kGroupSize - 1) / kGroupSize * kGroupSize, cases.back());  // whole workgroups
  return cases;
}

std::string judge(std::span<const ProbeCase> cases, std::span<const ProbeAnswer> answers) {
  for (std::size_t i = 0; i < cases.size(); ++i)
    if (std::string wrong = judge(cases[i], answers[i]); !wrong.empty()) return wrong;
  return {};
}

namespace {

/// The shader's answers, a case an invocation.
template <class Case, class Answer, class Judge>
std::string ask(Device& device, std::span<const std::uint32_t> shader, const std::vector<Case>& cases,
                const Judge& judged) {
  const std::size_t bytes = cases.size() * sizeof(Case);
  const Buffer upload(device, bytes, Buffer::Use::upload), input(device, bytes, Buffer::Use::device);
  const Buffer answers(device, cases.size() * sizeof(Answer), Buffer::Use::readback);
  const Kernel kernel(device, shader, {0, 1}, 0);
  Bindings bindings(device, {&kernel});
  bindings.set(0, input), bindings.set(1, answers);
  std::memcpy(upload.mapped<char>(), cases.data(), bytes);
  Commands commands(device);
  commands.start([&](VkCommandBuffer buffer) {
    copy(buffer, upload, 0, input, 0, bytes);
    barrier(buffer);
    kernel.bind(buffer, bindings.of(kernel), nullptr);
    vkCmdDispatch(buffer, static_cast<std::uint32_t>(cases.size() / kGroupSize), 1, 1);
    hand_to_host(buffer);
  });
  commands.wait();
  return judged(std::span<const Answer>(answers.template mapped<const Answer>(), cases.size()));
}

/// More than is lost where a factor of at most 64 meets a double below 2^-1022 that is taken for zero.
constexpr double kLostDouble = 0x1p-1014;

/// Whether x is high + low or one of its two neighbours, or both are next to nothing; high is the sum's nearest.
bool is_faithful(double x, double high, double low) {
  if (x == high || std::abs(x - high) <= kLostDouble) return true;
  return low != 0 && x == std::nextafter(high, low > 0 ? HUGE_VAL : -HUGE_VAL);
}

/// Of a sum, with the larger in magnitude first or not.
bool is_faithful_sum(double x, double a, double b) {
  const double sum = a + b, virtual_b = sum - a;
  return is_faithful(x, sum, (a - (sum - virtual_b)) + (b - virtual_b));
}

std::string judge(const DoubleCase& of, const DoubleAnswer& answer) {
  const auto [a, b, c] = of.x;
  if (!is_faithful_sum(answer.x[0], a, b)) return "its sum of two doubles is wrong";
  if (!is_faithful_sum(answer.x[1], a, -b)) return "its difference of two doubles is wrong";
  const double product = a * b, rest = std::fma(a, b, -product);
  if (!is_faithful(answer.x[2], product, rest)) return "its product of two doubles is wrong";
  bool is_unfused = false;
  for (const double rounded : {std::nextafter(product, -HUGE_VAL), product, std::nextafter(product, HUGE_VAL)})
    is_unfused |= is_faithful(rounded, product, rest) && is_faithful_sum(answer.x[3], rounded, -c);
  if (!is_unfused) return "it fuses a product and a difference of doubles";
  // Where the larger comes first, (x + y) - x is exact, whichever way the sum was rounded.
  if (std::abs(a) >= std::abs(b) && !is_faithful_sum(answer.x[4], b, a - answer.x[0]))
    return "it loses what a sum of two doubles leaves over";
  const bool is_near_nothing = std::abs(a) < 0x1p-1020 && std::abs(b) < 0x1p-1020;
  if (std::abs(answer.x[5] - std::max(a, b)) > kLostDouble) return "its maximum of doubles is wrong";
  if (std::abs(answer.x[6] - std::abs(a)) > kLostDouble) return "its absolute value of a double is wrong";
  if ((answer.above != 0) != (a > b) && !is_near_nothing) return "its comparison of doubles is wrong";
  const int sign = a > std::abs(b) ? 1 : a < -std::abs(b) ? -1 : 0;
  if (answer.sign != sign && !is_near_nothing) return "its comparison of a double with a bound is wrong";
  return {};
}

}  // namespace

std::string probe(Device& device) {
  const std::vector<ProbeCase> cases = probe_cases();
  return ask<ProbeCase, ProbeAnswer>(device, shader_probe_comp, cases,
                                     [&](std::span<const ProbeAnswer> answers) { return judge(cases, answers); });
}

std::vector<DoubleCase> double_cases() {
  std::vector<DoubleCase> cases;
  const auto add = [&](double a, double b) {
    cases.push_back({{a, b, a * b}}), cases.push_back({{b, a, 0x1p-30 * a}});
  };
  std::mt19937_64 random(2);
  const auto mantissa = [&] {
    const double m = 1 + static_cast<double>(random() >> 12) * 0x1p-52;
    return (random() & 1) != 0 ? m : -m;
  };
  for (int i = 0; i < 2000; ++i) add(std::ldexp(mantissa(), static_cast<int>(random() % 121) - 60), mantissa());
  // Halfway between two doubles, and next to it; and what nearly cancels.
  for (const double one : {1.0, 1 + 0x1p-52, 2 - 0x1p-52, 1.5}) {
    for (const double other : {0x1p-53, 0x1.0000000000001p-53, 0x1.fffffffffffffp-54, 0x1p-52, 0x1.8p-52, 0x1p-54,
                               1 - 0x1p-53, 1.0, 1 + 0x1p-52, 0.5, 2.0})
      for (const double sign : {1.0, -1.0}) add(one, sign * other);
  }
  // Far beyond the range of floats, and where doubles end.
  for (const double size : {0x1p-900, 0x1p-500, 0x1p-200, 0x1p200, 0x1p500})
    for (int i = 0; i < 20; ++i) add(size * mantissa(), mantissa());
  for (const double small : {0x1p-1074, 0x1p-1060, 0x1.8p-1023, 0x1p-1022, 0x1.0000000000001p-1022, 0.0})
    for (const double other : {0x1p-1074, 0x1.4p-1022, 0x1p-900, 0x1.8p-30, 1.0, -48.0}) add(small, other);
  cases.resize((cases.size() + kGroupSize - 1) / kGroupSize * kGroupSize, cases.back());
  return cases;
}

std::string judge(std::span<const DoubleCase> cases, std::span<const DoubleAnswer> answers) {
  for (std::size_t i = 0; i < cases.size(); ++i)
    if (std::string wrong = judge(cases[i], answers[i]); !wrong.empty()) return wrong;
  return {};
}

std::string probe_doubles(Device& device) {
  const std::vector<DoubleCase> cases = double_cases();
  return ask<DoubleCase, DoubleAnswer>(device, shader_probe_doubles_comp, cases,
                                       [&](std::span<const DoubleAnswer> answers) { return judge(cases, answers); });
}

}  // namespace impinge::gpu
