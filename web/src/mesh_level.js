import { arrayOf } from "./wasm.js";

// A mesh as it is now; arrays have their full length from the first level on.
export class MeshLevel {
  constructor(description) {
    this.name = description.name;
    this.groups = description.groups.map((group) => ({ ...group, first: 0, count: 0 }));
    this.vertices = this.wedges = this.triangles = 0;
    this.positions = new Float32Array(3 * description.wedges);
    this.indices = new Uint32Array(3 * description.triangles);
    this.attributes = description.attributes.map((attribute) => ({
      ...attribute, array: new (arrayOf(attribute))(description.wedges * attribute.count),
    }));
    this.strips = undefined;
  }

  // Writes a patch; returns the ranges that it changed, { wedges, triangles }: [[first, end] …].
  apply(patch) {
    const write = (array, width) => ({ first, data }) => {
      array.set(data, width * first);
      return [first, first + data.length / width];
    };
    const triangles = patch.indices.map(write(this.indices, 3));
    const wedges = patch.positions.map(write(this.positions, 3));
    patch.attributes.forEach((piece, i) => write(this.attributes[i].array, this.attributes[i].count)(piece));
    this.describe(patch);
    return { wedges, triangles };
  }

  // Takes all of a patch but its arrays.
  describe(patch) {
    Object.assign(this, { vertices: patch.vertices, wedges: patch.wedges, triangles: patch.triangles });
    if (patch.strips) this.strips = patch.strips;
    this.groups.forEach((group, i) => {
      group.first = patch.groupFirst[i];
      group.count = patch.groupFirst[i + 1] - patch.groupFirst[i];
    });
  }
}
