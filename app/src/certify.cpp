// SPDX-License-Identifier: GPL-3.0-or-later
#include "body_input.hpp"
#include "claim_report.hpp"
#include "command.hpp"
#include "hexact/exact/body_from_soup.hpp"
#include "hexact/exact/smooth_limit.hpp"
#include "hexact/io/mesh_file.hpp"
#include "hexact/kernel/errors.hpp"
#ifdef HEXACT_WITH_NEF
#include "hexact/nef/nef_solid.hpp"
#endif

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <variant>

namespace hexact::app {
namespace {

struct CertifyOptions {
  std::string mesh, output, format, engine = "planes";
  std::vector<std::string> claims{"closed", "planar", "convex"};
};

/// Names stand as words in certificates.
std::string body_name(std::string path) {
  std::replace_if(path.begin(), path.end(), [](unsigned char c) { return c <= ' ' || c == '#'; }, '_');
  return path;
}

struct Request {
  std::vector<Claim> claims;
  std::vector<NamedBody> bodies;
};

Request read_request(const std::vector<std::string>& texts) {
  Request request;
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    const std::string name = text.substr(0, equals);
    const bool alone = name == "closed" || name == "planar" || name == "trivalent" || name == "convex" || name == "embedded" ||
                       name == "smooth-limit";
    const bool about = name == "inside" || name == "tangent" || name == "corner-cut-of";
    if (!alone && !about) throw UsageError("there is no claim " + name);
    if (alone != (equals == std::string::npos) || equals + 1 == text.size()) {
      throw UsageError("claim " + name + (alone ? " needs no file" : " needs a file: " + name + "=FILE"));
    }
    if (alone) {
      request.claims.push_back({name, ""});
      continue;
    }
    const std::string path = text.substr(equals + 1);
    request.claims.push_back({name, body_name(path)});
    const auto known = [&](const NamedBody& b) { return b.name == body_name(path); };
    if (std::none_of(request.bodies.begin(), request.bodies.end(), known)) {
      request.bodies.push_back({body_name(path), read_body(path, "").body});
    }
  }
  return request;
}

/// Polygons that are no exact body: what refutes each claim.
Outcome refute_polygons(const PolygonSoup<Rational>& soup, const std::vector<Claim>& claims) {
  const SoupShape shape = examine_soup(soup);
  const auto first = [&] {
    if (shape.findings.empty()) return std::string("the polygons bound no exact body");
    return shape.findings.front().element + ": " + shape.findings.front().message;
  }();
  std::vector<ClaimVerdict> verdicts;
  for (const Claim& claim : claims) {
    const auto& valences = shape.topology.valences;
    const bool holds = claim.name == "closed"      ? shape.topology.is_one_closed_surface()
                       : claim.name == "planar"    ? shape.planar
                       : claim.name == "trivalent" ? valences.size() == 1 && valences.begin()->first == 3
                                                   : false;
    std::string witness = holds ? "" : first;
    if (claim.name == "planar" && !holds && !shape.bent_facets.empty()) {
      witness = facet_name(shape.bent_facets.front()) + ": its corners do not lie in one plane";
    }
    const Verdict failed = claim.name == "smooth-limit" ? Verdict::undecided : Verdict::refuted;
    verdicts.push_back({claim_text(claim), holds ? Verdict::proved : failed, witness});
  }
  return claim_outcome(verdicts, shape.planar ? "" : "rounded decimals are not planar; exactness lives in .planes files");
}

/// Claims that speak of a solid, which Boolean operations can decide; the others speak of loops and planes.
bool in_reach_of_nef(const Claim& claim) {
  return claim.name == "convex" || claim.name == "inside" || claim.name == "corner-cut-of";
}

#ifdef HEXACT_WITH_NEF
ClaimVerdict by_nef(const Certificate& certificate, const Claim& claim, const Common& common) {
  NefOptions options;
  if (common.max_facets != 0) options.max_facets = common.max_facets;
  const PlaneBody& body = certificate.body;
  if (body.plane_count() > 100) {
    common.remark(claim_text(claim) + " by Nef polyhedra, " + nef_cost_estimate(body.plane_count()));
  }
  if (claim.name == "convex") return nef_convex(body, options);
  const auto reference = std::find_if(certificate.bodies.begin(), certificate.bodies.end(),
                                      [&](const NamedBody& b) { return b.name == claim.reference; });
  if (claim.name == "inside") return nef_inside(body, reference->body, options);
  return nef_corner_cut(reference->body, body, options);
}
#else
ClaimVerdict by_nef(const Certificate&, const Claim&, const Common&) {
  return {"", Verdict::undecided, "this hexact was built without the engine nef"};
}
#endif

/// Nef decides what is in its reach; `both` asks for agreement. The claims about loops and planes rest on the signs.
std::vector<ClaimVerdict> decide(const Certificate& certificate, const std::string& engine, const Common& common) {
  std::vector<ClaimVerdict> verdicts = verify(certificate, common.work.part(0.3, engine == "planes" ? 0.9 : 0.6));
  if (engine == "planes") return verdicts;
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    const Claim& claim = certificate.claims[i];
    // Nef sees a solid; loops that bound none are refuted by the signs already.
    if (!in_reach_of_nef(claim) || (engine == "both" && verdicts[i].verdict != Verdict::proved)) continue;
    common.work.check();
    ClaimVerdict nef = by_nef(certificate, claim, common);
    if (engine == "both" && nef.verdict == Verdict::refuted) {
      throw ContractViolation("the signs prove " + claim_text(claim) + " and Nef polyhedra refute it: " + nef.witness);
    }
    nef.claim = claim_text(claim);
    verdicts[i] = std::move(nef);
  }
  return verdicts;
}

/// Beside the verdict of smooth-limit, its numbers level by level.
void report_smooth_limit(const Certificate& certificate, Outcome& outcome) {
  if (std::none_of(certificate.claims.begin(), certificate.claims.end(), [](const Claim& c) { return c.name == "smooth-limit"; })) return;
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const SmoothLevel& l : smooth_limit(certificate.body).levels) {
    rows.push_back({{"level", l.level}, {"largest_share", l.largest_share}, {"angle_bound_deg", l.angle_bound_deg},
                    {"later_sine", std::isfinite(l.later_sine) ? nlohmann::ordered_json(l.later_sine) : nlohmann::ordered_json()}});
    outcome.text += fmt::format("chamfer level {}: lifts take at most {:.4f} of what is left, angles at most {:.4f} degrees\n", l.level,
                                l.largest_share, l.angle_bound_deg);
  }
  outcome.report["smooth_limit"] = rows;
}

Outcome certify(const CertifyOptions& options, const Common& common) {
  if (options.output == "-" && common.json) throw UsageError("--json and the certificate cannot both go to standard output");
  Request request = read_request(options.claims);
  io::Geometry geometry = io::read_geometry(options.mesh, named_format(options.format));
  PlaneBody body;
  if (const auto* soup = std::get_if<PolygonSoup<Rational>>(&geometry)) {
    try {
      body = body_from_soup(*soup, SoupRule::planar);
    } catch (const InvalidInput&) {
      return refute_polygons(*soup, request.claims);
    }
  } else if (auto* planes = std::get_if<PlaneBody>(&geometry)) {
    body = std::move(*planes);
  } else {
    body = std::move(std::get<Certificate>(geometry).body);
  }
  const Certificate certificate =
      make_certificate(std::move(body), std::move(request.claims), std::move(request.bodies),
                       {"hexact " HEXACT_VERSION, "engine " + options.engine}, common.work.part(0.1, 0.3));
  const std::vector<ClaimVerdict> verdicts = decide(certificate, options.engine, common);
  Outcome outcome = claim_outcome(verdicts);
  common.work.report(0.9);
  report_smooth_limit(certificate, outcome);
  if (outcome.exit_code == kDone && !options.output.empty()) io::write_certificate(options.output, certificate);
  if (options.output == "-") outcome.text.clear();
  return outcome;
}

}  // namespace

void add_certify(const Registry& registry) {
  const auto options = std::make_shared<CertifyOptions>();
  CLI::App* command = registry.add("certify", "Prove properties of a mesh with exact arithmetic and write a certificate");
  command->add_option("mesh", options->mesh, "Mesh, .planes file or certificate; - for standard input")->required();
  command->add_option("-o,--output", options->output, "Certificate to write when every claim is proved");
  command->add_option("--prove", options->claims,
                      "Claims: closed, planar, trivalent, convex, embedded, inside=FILE, tangent=FILE, corner-cut-of=FILE, smooth-limit "
                      "(default: closed,planar,convex)")
      ->delimiter(',');
  command->add_option("--engine", options->engine, "Signs of planes, Boolean operations on Nef polyhedra, or both")
      ->check(CLI::IsMember({"planes", "nef", "both"}));
  command->add_option("--from", options->format, "Format of the input");
  Common& common = registry.common;
  command->callback([&selected = registry.selected, &common, options] {
    selected = [&common, options] { return certify(*options, common); };
  });
}

}  // namespace hexact::app
