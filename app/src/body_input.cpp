// SPDX-License-Identifier: GPL-3.0-or-later
#include "body_input.hpp"

#include "command.hpp"
#include "hexact/exact/body_from_soup.hpp"

namespace hexact::app {
namespace {

struct ToBody {
  PlaneBody operator()(const PolygonSoup<Rational>& soup) const { return body_from_soup(soup); }
  PlaneBody operator()(PlaneBody& body) const { return std::move(body); }
  PlaneBody operator()(Certificate& certificate) const { return std::move(certificate.body); }
};

}  // namespace

std::optional<io::Format> named_format(const std::string& name) {
  if (name.empty()) return std::nullopt;
  const auto format = io::format_from_name(name);
  if (!format) throw UsageError("there is no format " + name);
  return format;
}

BodyInput read_body(const std::string& path, const std::string& format_name) {
  io::Geometry geometry = io::read_geometry(path, named_format(format_name));
  return {std::visit(ToBody{}, geometry), path};
}

}  // namespace hexact::app
