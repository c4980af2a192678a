// SPDX-License-Identifier: MIT
// Contacts of one's own polygons, with nothing else of the toolkit: a block of 2 x 1 m that has
// sunk 1 mm into the floor, and one of 1 x 1 m that stands on it with half its base.
#include <cmath>
#include <cstdio>
#include <voussoir/detection/contact_search.hpp>
#include <voussoir/detection/face_contacts.hpp>
using namespace voussoir;

int main() {
  PlacedShapes<2> shapes;
  const auto add = [&](std::vector<Vec2> corners) {  // anticlockwise [m]
    shapes.add(ConvexPolygon(corners), corners.front());
  };
  add({{-5, -1}, {5, -1}, {5, 0}, {-5, 0}});
  add({{0, -0.001}, {2, -0.001}, {2, 0.999}, {0, 0.999}});
  add({{1.5, 0.999}, {2.5, 0.999}, {2.5, 1.999}, {1.5, 1.999}});

  ContactSearch<FaceContacts, 2> search(1e-6, 0.1);  // open by up to 1e-6 m; margin of neighbours
  double length = 0;
  const ContactList<2>& contacts = search.run(shapes);
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const auto& c = contacts[k];
    std::printf("%u on %u: over %.3f m, depth %.4f m, normal (%g, %g)\n", c.b, c.a, c.measure,
                0.0 - c.separation, c.normal.x(), c.normal.y());
    length += c.measure;
  }
  return contacts.size() == 2 && std::abs(length - 2.5) < 1e-12 ? 0 : 1;
}
