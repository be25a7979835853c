// SPDX-License-Identifier: GPL-3.0-or-later
// Limits and sizes of open meshes by subdivide --scheme midedge and midedge6, as a user runs them.
#include "program.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <vector>

using namespace hexact;
using program::run;

namespace {

using Vertices = std::vector<std::array<double, 3>>;

/// m × n quadrilaterals of height z(i, j), vertices row by row.
template <class Height>
std::string grid(int m, int n, const Height& z) {
  std::ostringstream out;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= m; ++i) out << "v " << i << ' ' << j << ' ' << z(i, j) << '\n';
  }
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < m; ++i) {
      const int a = j * (m + 1) + i + 1;
      out << "f " << a << ' ' << a + 1 << ' ' << a + m + 2 << ' ' << a + m + 1 << '\n';
    }
  }
  return out.str();
}

const char* const kTetrahedron = "v 50 0 0\nv 53 0 0\nv 50 3 0\nv 50 0 3\n";

/// A tetrahedron behind the mesh that has `vertices` already.
std::string with_tetrahedron(const std::string& mesh, int vertices) {
  const auto facet = [&](int a, int b, int c) {
    return "f " + std::to_string(vertices + a) + ' ' + std::to_string(vertices + b) + ' ' + std::to_string(vertices + c) + '\n';
  };
  const std::size_t facets = mesh.find("f ");
  return mesh.substr(0, facets) + kTetrahedron + mesh.substr(facets) + facet(1, 3, 2) + facet(1, 2, 4) + facet(1, 4, 3) + facet(2, 3, 4);
}

Vertices vertices_of(const program::Folder& folder, const char* name) {
  std::istringstream in(program::read_bytes((folder.path() / name).string()));
  Vertices result;
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with("v ")) continue;
    std::istringstream words(line.substr(2));
    auto& p = result.emplace_back();
    words >> p[0] >> p[1] >> p[2];
  }
  return result;
}

nlohmann::json json_of(const program::Folder& folder, const char* name) {
  return nlohmann::json::parse(program::read_bytes((folder.path() / name).string()));
}

nlohmann::json report(const program::Run& result) {
  CAPTURE(result.err);
  REQUIRE(result.status == 0);
  return nlohmann::json::parse(result.out);
}

}  // namespace

TEST_CASE("dual: every facet of an open mesh has its limit, those at the boundary without plane", "[app][midedge]") {
  const program::Folder folder;
  program::write_bytes((folder.path() / "g.obj").string(), grid(5, 5, [](int i, int j) { return i * i + 3 * i * j; }));
  (void)report(run(folder, "$hexact subdivide g.obj --scheme midedge6 --levels 0 --limit-points a.json -o a.obj --json"));
  (void)report(run(folder, "$hexact subdivide g.obj --scheme midedge6 --arithmetic rational --levels 4 --limit-points b.json -o b.obj --json"));
  const auto a = json_of(folder, "a.json").at("facets"), b = json_of(folder, "b.json").at("facets");
  for (std::size_t f = 0; f < 25; ++f) {
    const bool inner = f % 5 > 0 && f % 5 < 4 && f / 5 > 0 && f / 5 < 4;
    CHECK(a[f].at("exact") == b[f].at("exact"));
    CHECK(a[f].at("bound").is_number());
    CHECK(a[f].at("plane").is_null() != inner);
    CHECK(a[f].contains("normal_bound") == inner);
  }
  // The middle of the left side, two facets from the corners: x² has 89353/138722 there, x(y − 2) has 1/4.
  CHECK(a[10].at("exact") == nlohmann::json({"1/2", "5/2", "1219121/277444"}));
}

TEST_CASE("--limit on an open mesh: half a cell inside under dual, one point for each loop under close", "[app][midedge]") {
  const program::Folder folder;
  program::write_bytes((folder.path() / "g.obj").string(), grid(4, 3, [](int i, int j) { return 2 * i - j; }));
  for (const std::string scheme : {"midedge", "midedge6"}) {
    const auto dual = run(folder, "$hexact subdivide g.obj --scheme " + scheme + " --levels 0 --limit -o on.obj --json");
    (void)report(dual);
    CHECK(dual.err.find("contracts") == std::string::npos);
    const Vertices on = vertices_of(folder, "on.obj");
    REQUIRE(on.size() == 20);
    const auto inside = [](int x, int last) { return x == 0 ? 0.5 : x == last ? last - 0.5 : x; };
    for (int v = 0; v < 20; ++v) {
      const double x = inside(v % 5, 4), y = inside(v / 5, 3);
      CHECK(on[static_cast<std::size_t>(v)] == std::array{x, y, 2 * x - y});
    }
    const auto close = run(folder, "$hexact subdivide g.obj --scheme " + scheme + " --boundary close --levels 3 --limit -o on.obj --json");
    const auto levels = report(close).at("levels");
    CHECK(close.err.find("each boundary loop contracts to one point") != std::string::npos);
    const Vertices closed = vertices_of(folder, "on.obj");
    // The boundary of 14 vertices has the mean (2, 3/2, 5/2).
    CHECK(std::count(closed.begin(), closed.end(), std::array{2.0, 1.5, 2.5}) >= 14);
    CHECK(levels.size() == 4);
  }
  const auto drop = run(folder, "$hexact subdivide g.obj --scheme midedge --boundary drop --levels 2 --limit -o no.obj --json");
  CHECK(drop.status == 3);
  CHECK(drop.out.find("\"HasBoundary\"") != std::string::npos);
  CHECK(drop.out.find("dual or close") != std::string::npos);
  CHECK(program::read_bytes((folder.path() / "no.obj").string()).empty());
}

TEST_CASE("close and drop: limits of all facets, and of none at the boundary", "[app][midedge]") {
  const program::Folder folder;
  program::write_bytes((folder.path() / "g.obj").string(), grid(4, 3, [](int i, int j) { return i * j * j; }));
  const auto facets = [&](const std::string& boundary) {
    (void)report(run(folder, "$hexact subdivide g.obj --scheme midedge6 --levels 0 --limit-points l.json -o a.obj --json --boundary " + boundary));
    return json_of(folder, "l.json").at("facets");
  };
  for (const auto& entry : facets("close")) CHECK((entry.at("point").is_array() && entry.at("plane").is_array()));
  for (const auto& entry : facets("drop")) CHECK((entry.at("point").is_null() && entry.at("bound").is_null() && entry.at("plane").is_null()));
}

TEST_CASE("--keep-size: open components keep their area, closed ones beside them their volume", "[app][midedge]") {
  const program::Folder folder;
  const auto file = [&](const char* name, const std::string& bytes) { program::write_bytes((folder.path() / name).string(), bytes); };
  const std::string hills = grid(5, 4, [](int i, int j) { return (i * 3 + j * 5) % 4; });
  file("g.obj", hills);
  file("two.obj", with_tetrahedron(hills, 30));
  for (const std::string options : {"--scheme midedge6", "--scheme midedge --arithmetic rational", "--scheme midedge6 --boundary close"}) {
    const auto r = report(run(folder, "$hexact subdivide g.obj --keep-size --levels 4 -o a.obj --json " + options));
    for (const auto& row : r.at("levels")) CHECK(row.at("area").get<double>() == Approx(r.at("levels")[0].at("area").get<double>()).epsilon(1e-12));
    CHECK(r.at("size_measures") == nlohmann::json({"area"}));
    CHECK(r.at("size_factors")[0].get<double>() > 1);
  }
  const auto plain = report(run(folder, "$hexact subdivide g.obj --scheme midedge6 --levels 4 -o a.obj --json"));
  CHECK(plain.at("levels")[2].at("area").get<double>() < 0.7 * plain.at("levels")[0].at("area").get<double>());
  const auto two = run(folder, "$hexact subdivide two.obj --scheme midedge6 --keep-size --levels 4 -o a.obj --json");
  CHECK(report(two).at("size_measures") == nlohmann::json({"area", "volume"}));
  const auto text = run(folder, "$hexact subdivide two.obj --scheme midedge6 --keep-size --levels 4 -o b.obj");
  CHECK(text.out.find("component 1 keeps its volume: scaled by ") != std::string::npos);
  CHECK(program::read_bytes((folder.path() / "a.obj").string()) == program::read_bytes((folder.path() / "b.obj").string()));
  file("flat.obj", "v 0 0 0\nv 1 1 1\nv 2 2 2\nv 3 3 3\nf 1 2 3 4\n");
  const auto none = run(folder, "$hexact subdivide flat.obj --scheme midedge6 --keep-size --levels 2 -o no.obj --json");
  CHECK(none.status == 3);
  CHECK(none.out.find("\"NoArea\"") != std::string::npos);
  CHECK(none.out.find("facet 0") != std::string::npos);
}

TEST_CASE("limits and scaled sizes of open meshes are the same bytes for any number of threads", "[app][midedge]") {
  const program::Folder folder;
  program::write_bytes((folder.path() / "g.obj").string(), grid(30, 20, [](int i, int j) { return (i * i + 7 * j) % 5; }));
  for (const std::string threads : {"1", "2"}) {
    (void)report(run(folder, "$hexact subdivide g.obj --scheme midedge6 --levels 2 --keep-size --limit --limit-points l" + threads + ".json -o o" +
                                 threads + ".obj --json --threads " + threads));
  }
  for (const std::string kind : {"l%.json", "o%.obj"}) {
    const auto bytes = [&](char c) {
      std::string name = kind;
      name[1] = c;
      return program::read_bytes((folder.path() / name).string());
    };
    CHECK(bytes('1').size() > 10000);
    CHECK(bytes('1') == bytes('2'));
  }
}

TEST_CASE("drop: bounds are those of the levels that come, not of an estimate", "[app][midedge]") {
  const program::Folder folder;
  program::write_bytes((folder.path() / "t.obj").string(), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  program::write_bytes((folder.path() / "g.obj").string(), grid(4, 3, [](int, int) { return 0; }));
  const auto triangle = report(run(folder, "$hexact subdivide t.obj --scheme midedge --boundary drop --levels 40 -o a.obj --json"));
  CHECK(triangle.at("levels")[40].at("faces") == 1);
  const std::string command = "$hexact subdivide g.obj --scheme midedge --boundary drop --levels 10 -o a.obj --json --max-facets ";
  const auto levels = report(run(folder, command + "1000")).at("levels");
  const auto last = levels[10].at("faces").get<std::size_t>();
  CHECK(last > levels[9].at("faces").get<std::size_t>());
  CHECK(report(run(folder, command + std::to_string(last))).at("levels").size() == 11);
  const auto refused = run(folder, command + std::to_string(last - 1));
  CHECK(refused.status == 4);
  CHECK(refused.out.find("level 10 would have " + std::to_string(last) + " facets") != std::string::npos);
}

TEST_CASE("figures of very large and very small meshes", "[app][midedge]") {
  const program::Folder folder;
  const auto cube = [&](const std::string& x) {
    std::string text;
    for (int i = 0; i < 8; ++i) {
      for (const int axis : {1, 2, 4}) text += (axis == 1 ? "v " : " ") + std::string(i & axis ? "" : "-") + x;
      text += '\n';
    }
    program::write_bytes((folder.path() / "c.obj").string(), text + "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n");
  };
  const std::string command = "$hexact subdivide c.obj --scheme midedge6 --levels 2 --keep-size -o a.obj ";
  cube("1");
  const auto expected = report(run(folder, command + "--json"));
  for (const std::string size : {"1e103", "1e200", "1e-200"}) {
    cube(size);
    for (const std::string arithmetic : {"double", "rational"}) {
      const auto r = report(run(folder, command + "--json --arithmetic " + arithmetic));
      CHECK(r.at("size_factors")[0].get<double>() == Approx(expected.at("size_factors")[0].get<double>()).epsilon(1e-12));
      for (const char* angle : {"max_normal_angle_deg", "median_normal_angle_deg"}) {
        CHECK(r.at("levels")[2].at(angle).get<double>() == Approx(expected.at("levels")[2].at(angle).get<double>()).epsilon(1e-12));
      }
    }
  }
  // Lengths, areas and volumes that no double holds are not shown as numbers.
  cube("1e308");
  const auto text = run(folder, command + "--arithmetic rational");
  CHECK(text.status == 0);
  CHECK(text.out.find("nan") == std::string::npos);
  CHECK(text.out.find("inf") == std::string::npos);
  CHECK(text.out.find(" - ") != std::string::npos);
  CHECK(report(run(folder, command + "--arithmetic rational --json")).at("levels")[0].at("volume").is_null());
}

TEST_CASE("a pipe can be named as the output", "[app]") {
  const program::Folder folder;
  const auto direct = run(folder, "$hexact make cube -o - --to obj");
  REQUIRE(direct.status == 0);
  const auto piped = run(folder, "$hexact make cube -o /dev/stdout --to obj --quiet | cat");
  CHECK(piped.out.starts_with(direct.out));
  CHECK(piped.err.empty());
}
