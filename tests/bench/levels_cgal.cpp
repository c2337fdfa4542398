// CGAL's edge collapses with the policies of Garland and Heckbert and of Lindstrom and Turk.

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/GarlandHeckbert_policies.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_placement.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include <cmath>

#include "tests/bench/levels_peers.h"

namespace pstrips::bench {
namespace {

namespace Sms = CGAL::Surface_mesh_simplification;
using Kernel = CGAL::Simple_cartesian<double>;
using Peer = CGAL::Surface_mesh<Kernel::Point_3>;

Peer peer_of(const Shape& shape) {
  Peer mesh;
  for (std::size_t i = 0; i < shape.positions.size(); i += 3)
    mesh.add_vertex({shape.positions[i], shape.positions[i + 1], shape.positions[i + 2]});
  for (std::size_t t = 0; t < shape.triangles.size(); t += 3)
    mesh.add_face(Peer::Vertex_index(shape.triangles[t]),
                  Peer::Vertex_index(shape.triangles[t + 1]),
                  Peer::Vertex_index(shape.triangles[t + 2]));
  return mesh;
}

Shape shape_of(const Peer& mesh) {
  Shape out;
  out.positions.resize(3 * (mesh.number_of_vertices() + mesh.number_of_removed_vertices()));
  for (const auto v : mesh.vertices())
    for (int k = 0; k < 3; ++k)
      out.positions[3 * std::size_t{v} + static_cast<std::size_t>(k)] = mesh.point(v)[k];
  for (const auto f : mesh.faces())
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f)))
      out.triangles.push_back(static_cast<Index>(v));
  return out;
}

// Policies stop by edges: a triangle has one and a half of them, and one more for each two on the
// border. Stopping may be a collapse late or early.
std::size_t edges_for(const Peer& mesh, std::uint64_t triangles) {
  std::size_t border = 0;
  for (const auto h : mesh.halfedges()) border += mesh.is_border(h) ? 1 : 0;
  const double share = static_cast<double>(triangles) / static_cast<double>(mesh.number_of_faces());
  const double open = static_cast<double>(border) / 2 * std::sqrt(share);
  return static_cast<std::size_t>(1.5 * static_cast<double>(triangles) + open);
}

template <class Collapse>
Timed run(const Shape& source, std::uint64_t target, Collapse&& collapse) {
  Peer mesh = peer_of(source);
  const Sms::Count_stop_predicate<Peer> stop(edges_for(mesh, target));
  const double start = cpu_seconds();
  collapse(mesh, stop);
  const double seconds = cpu_seconds() - start;
  return {shape_of(mesh), seconds};
}

}  // namespace

Timed cgal_garland_heckbert(const Shape& source, std::uint64_t target) {
  return run(source, target, [](Peer& mesh, const auto& stop) {
    Sms::GarlandHeckbert_plane_policies<Peer, Kernel> policies(mesh);
    Sms::edge_collapse(
        mesh, stop,
        CGAL::parameters::get_cost(policies.get_cost()).get_placement(policies.get_placement()));
  });
}

Timed cgal_lindstrom_turk(const Shape& source, std::uint64_t target) {
  return run(source, target, [](Peer& mesh, const auto& stop) {
    Sms::edge_collapse(mesh, stop,
                       CGAL::parameters::get_cost(Sms::LindstromTurk_cost<Peer>())
                           .get_placement(Sms::LindstromTurk_placement<Peer>()));
  });
}

}  // namespace pstrips::bench
