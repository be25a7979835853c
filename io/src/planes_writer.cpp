// SPDX-License-Identifier: LGPL-3.0-or-later
#include "number_text.hpp"
#include "plane_text.hpp"

#include "hexact/io/mesh_file.hpp"
#include "hexact/kernel/errors.hpp"

#include <algorithm>

namespace hexact::io {
namespace {

void append_plane(std::string& text, const PlaneBody& body, std::size_t i) {
  if (body.field == Field::sqrt5) {
    const auto& p = body.planes_sqrt5[i];
    for (const QuadraticField* value : {&p.a, &p.b, &p.c, &p.d}) text.append(value->str()).push_back(' ');
  } else if (body.planes.is_narrow(i)) {
    for (const std::int64_t value : body.planes.narrow(i)) append_integer(text, value).push_back(' ');
  } else {
    const auto& p = body.planes.wide(i);
    for (const Integer* value : {&p.a, &p.b, &p.c, &p.d}) text.append(value->str()).push_back(' ');
  }
  const FacetAddress& address = body.addresses[i];
  append_integer(text, address.level).push_back(' ');
  if (address.parent) {
    append_integer(text, index(*address.parent));
  } else {
    text.push_back('-');
  }
  text.push_back('\n');
}

std::array<FacetId, 3> sorted(std::array<FacetId, 3> triple) {
  std::sort(triple.begin(), triple.end());
  return triple;
}

/// True when a reader would find the same planes at every vertex without being told.
bool triples_are_implied(const PlaneBody& body) {
  for (const VertexId corner : body.loops.corners()) HEXACT_EXPECTS(index(corner) < body.triples.size());
  const DerivedTriples derived = derive_triples(body.loops, body.triples.size());
  return !derived.offending &&
         std::equal(derived.triples.begin(), derived.triples.end(), body.triples.begin(), body.triples.end(),
                    [](const auto& a, const auto& b) { return a == b || sorted(a) == sorted(b); });
}

}  // namespace

void append_body(std::string& text, const PlaneBody& body) {
  HEXACT_EXPECTS(body.addresses.size() == body.plane_count() && body.loops.size() == body.plane_count());
  constexpr std::size_t kPlaneBytes = 64, kCornerBytes = 8;
  text.reserve(text.size() + kPlaneBytes * body.plane_count() + kCornerBytes * body.loops.corner_count());
  text += body.field == Field::rational ? "field Q\n" : "field Q(sqrt5)\n";
  append_integer(text += "scale ", body.scale).push_back('\n');
  if (std::any_of(body.shift.begin(), body.shift.end(), [](const Rational& s) { return !s.is_zero(); })) {
    text += "shift " + body.shift[0].str() + " " + body.shift[1].str() + " " + body.shift[2].str() + "\n";
  }
  append_integer(text += "planes ", body.plane_count()).push_back('\n');
  for (std::size_t i = 0; i < body.plane_count(); ++i) append_plane(text, body, i);
  append_integer(text += "loops ", body.loops.size()).push_back('\n');
  for (std::size_t f = 0; f < body.loops.size(); ++f) {
    append_integer(text, body.loops[f].size());
    for (const VertexId corner : body.loops[f]) append_integer(text += ' ', index(corner));
    text.push_back('\n');
  }
  if (triples_are_implied(body)) return;
  append_integer(text += "vertices ", body.triples.size()).push_back('\n');
  for (const auto& t : body.triples) {
    append_integer(text, index(t[0])).push_back(' ');
    append_integer(text, index(t[1])).push_back(' ');
    append_integer(text, index(t[2])).push_back('\n');
  }
}

std::string planes_text(const PlaneBody& body) {
  std::string text = "hexact-planes 1\n";
  append_body(text, body);
  return text;
}

}  // namespace hexact::io
