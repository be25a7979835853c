// SPDX-License-Identifier: LGPL-3.0-or-later
#include "sha256.hpp"

#include <gmpxx.h>

#include <array>
#include <cstdint>
#include <cstdio>

namespace check {
namespace {

using State = std::array<std::uint32_t, 8>;

struct Constants {
  std::array<std::uint32_t, 64> round{};
  State start{};
};

// The first 32 bits behind the point of a root of a prime.
std::uint32_t root_bits(unsigned prime, unsigned root) {
  mpz_class x = prime;
  x <<= 32 * root;
  mpz_root(x.get_mpz_t(), x.get_mpz_t(), root);
  return static_cast<std::uint32_t>(mpz_class(x & 0xffffffffUL).get_ui());
}

Constants make_constants() {
  Constants c;
  unsigned prime = 2;
  for (std::size_t i = 0; i < 64; ++i, ++prime) {
    for (unsigned d = 2; d * d <= prime; ++d) {
      if (prime % d == 0) ++prime, d = 1;
    }
    c.round[i] = root_bits(prime, 3);
    if (i < 8) c.start[i] = root_bits(prime, 2);
  }
  return c;
}

std::uint32_t rotated(std::uint32_t x, int n) { return (x >> n) | (x << (32 - n)); }

void add_block(State& state, const unsigned char* block, const Constants& c) {
  std::array<std::uint32_t, 64> w{};
  for (std::size_t i = 0; i < 16; ++i) {
    const unsigned char* b = block + 4 * i;
    w[i] = std::uint32_t{b[0]} << 24 | std::uint32_t{b[1]} << 16 | std::uint32_t{b[2]} << 8 | std::uint32_t{b[3]};
  }
  for (std::size_t i = 16; i < 64; ++i) {
    const std::uint32_t x = w[i - 15], y = w[i - 2];
    w[i] = w[i - 16] + (rotated(x, 7) ^ rotated(x, 18) ^ (x >> 3)) + w[i - 7] + (rotated(y, 17) ^ rotated(y, 19) ^ (y >> 10));
  }
  State s = state;
  for (std::size_t i = 0; i < 64; ++i) {
    const std::uint32_t t = s[7] + (rotated(s[4], 6) ^ rotated(s[4], 11) ^ rotated(s[4], 25)) +
                            ((s[4] & s[5]) ^ (~s[4] & s[6])) + c.round[i] + w[i];
    const std::uint32_t u = (rotated(s[0], 2) ^ rotated(s[0], 13) ^ rotated(s[0], 22)) +
                            ((s[0] & s[1]) ^ (s[0] & s[2]) ^ (s[1] & s[2]));
    s = {t + u, s[0], s[1], s[2], s[3] + t, s[4], s[5], s[6]};
  }
  for (std::size_t i = 0; i < 8; ++i) state[i] += s[i];
}

}  // namespace

std::string sha256(std::string_view bytes) {
  const Constants c = make_constants();
  State state = c.start;
  const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
  const std::size_t whole = bytes.size() / 64 * 64;
  for (std::size_t at = 0; at < whole; at += 64) add_block(state, data + at, c);
  std::array<unsigned char, 128> last{};
  const std::size_t rest = bytes.size() - whole, blocks = rest < 56 ? 1 : 2;
  for (std::size_t i = 0; i < rest; ++i) last[i] = data[whole + i];
  last[rest] = 0x80;
  const std::uint64_t bits = std::uint64_t{bytes.size()} * 8;
  for (std::size_t i = 0; i < 8; ++i) last[64 * blocks - 1 - i] = static_cast<unsigned char>(bits >> (8 * i));
  for (std::size_t i = 0; i < blocks; ++i) add_block(state, last.data() + 64 * i, c);
  std::string hex;
  for (const std::uint32_t word : state) {
    std::array<char, 9> digits{};
    std::snprintf(digits.data(), digits.size(), "%08x", word);
    hex += digits.data();
  }
  return hex;
}

}  // namespace check
