// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/io/mesh_file.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

namespace hexact::io {
namespace {

// FIPS 180-4, section 6.2. The constants (4.2.2 and 5.3.3) are the first 32 bits of the fractional parts of the cube
// roots of the first 64 primes and of the square roots of the first 8; they are computed here by integer roots.

constexpr std::array<std::uint32_t, 64> first_primes() {
  std::array<std::uint32_t, 64> primes{};
  std::size_t found = 0;
  for (std::uint32_t n = 2; found < primes.size(); ++n) {
    bool prime = true;
    for (std::size_t i = 0; i < found; ++i) prime = prime && n % primes[i] != 0;
    if (prime) primes[found++] = n;
  }
  return primes;
}

/// The low 32 bits of floor(2^32 · n^(1/power)), power 2 or 3, bit by bit.
constexpr std::uint32_t root_fraction(std::uint32_t n, int power) {
  std::uint64_t root = 0;
  for (int bit = 36; bit >= 0; --bit) {
    const std::uint64_t trial = root | std::uint64_t{1} << bit;
    // trial^power <= n · 2^(32·power); the cube has up to 111 bits.
    unsigned __int128 value = static_cast<unsigned __int128>(trial) * trial;
    if (power == 3) value *= trial;
    if (value <= static_cast<unsigned __int128>(n) << (32 * power)) root = trial;
  }
  return static_cast<std::uint32_t>(root);
}

constexpr std::array<std::uint32_t, 64> round_constants() {
  std::array<std::uint32_t, 64> constants{};
  const auto primes = first_primes();
  for (std::size_t i = 0; i < 64; ++i) constants[i] = root_fraction(primes[i], 3);
  return constants;
}

constexpr std::array<std::uint32_t, 8> initial_state() {
  std::array<std::uint32_t, 8> state{};
  const auto primes = first_primes();
  for (std::size_t i = 0; i < 8; ++i) state[i] = root_fraction(primes[i], 2);
  return state;
}

constexpr auto kRounds = round_constants();

void add_block(std::array<std::uint32_t, 8>& state, const unsigned char* block) {
  std::array<std::uint32_t, 64> w;
  for (std::size_t t = 0; t < 16; ++t) {
    w[t] = std::uint32_t{block[4 * t]} << 24 | std::uint32_t{block[4 * t + 1]} << 16 |
           std::uint32_t{block[4 * t + 2]} << 8 | std::uint32_t{block[4 * t + 3]};
  }
  for (std::size_t t = 16; t < 64; ++t) {
    const std::uint32_t s0 = std::rotr(w[t - 15], 7) ^ std::rotr(w[t - 15], 18) ^ (w[t - 15] >> 3);
    const std::uint32_t s1 = std::rotr(w[t - 2], 17) ^ std::rotr(w[t - 2], 19) ^ (w[t - 2] >> 10);
    w[t] = w[t - 16] + s0 + w[t - 7] + s1;
  }
  auto [a, b, c, d, e, f, g, h] = state;
  for (std::size_t t = 0; t < 64; ++t) {
    const std::uint32_t s1 = std::rotr(e, 6) ^ std::rotr(e, 11) ^ std::rotr(e, 25);
    const std::uint32_t t1 = h + s1 + ((e & f) ^ (~e & g)) + kRounds[t] + w[t];
    const std::uint32_t s0 = std::rotr(a, 2) ^ std::rotr(a, 13) ^ std::rotr(a, 22);
    const std::uint32_t t2 = s0 + ((a & b) ^ (a & c) ^ (b & c));
    h = g, g = f, f = e, e = d + t1, d = c, c = b, b = a, a = t1 + t2;
  }
  const std::array<std::uint32_t, 8> sum = {a, b, c, d, e, f, g, h};
  for (std::size_t i = 0; i < 8; ++i) state[i] += sum[i];
}

}  // namespace

std::string sha256_hex(std::string_view bytes) {
  std::array<std::uint32_t, 8> state = initial_state();
  const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
  const std::size_t whole = bytes.size() / 64;
  for (std::size_t i = 0; i < whole; ++i) add_block(state, data + 64 * i);
  std::array<unsigned char, 128> tail{};
  const std::size_t rest = bytes.size() - 64 * whole;
  if (rest != 0) std::memcpy(tail.data(), data + 64 * whole, rest);
  tail[rest] = 0x80;
  const std::size_t length = rest < 56 ? 64 : 128;
  for (std::size_t i = 0; i < 8; ++i) {
    tail[length - 1 - i] = static_cast<unsigned char>(static_cast<std::uint64_t>(bytes.size()) * 8 >> (8 * i));
  }
  for (std::size_t i = 0; i < length; i += 64) add_block(state, tail.data() + i);
  std::string text;
  for (const std::uint32_t word : state) {
    for (int nibble = 7; nibble >= 0; --nibble) text += "0123456789abcdef"[word >> (4 * nibble) & 15];
  }
  return text;
}

}  // namespace hexact::io
