// Draws the people of a .glb that `throng run SCENE --figures baked -o run.glb` wrote: one draw call for each body and level of detail.
//
// The poses stay on the graphics processor. For each person a frame needs two numbers of poses and the share of the way between them.
import * as THREE from 'three';

/** Texels in a row of a texture. */
const WIDTH = 4096;

const VERTEX = `
uniform highp isampler2D turns;
uniform highp sampler2D hips;
uniform int parents[JOINTS];
uniform vec3 offsets[JOINTS];
uniform vec3 rests[JOINTS];
uniform vec3 looks[COLOURS];
in vec4 skinIndex, skinWeight;
in vec3 poses;  // the pose before, the pose after, the share of the way
in vec2 person; // the height, the look
#ifdef REGIONS
in float _region;
out vec3 vLook;
#endif

ivec2 texel(int at) { return ivec2(at % ${WIDTH}, at / ${WIDTH}); }
vec3 rotated(vec4 q, vec3 v) { return v + 2.0 * cross(q.xyz, cross(q.xyz, v) + q.w * v); }
vec4 turned(int joint) {
  vec4 a = vec4(texelFetch(turns, texel(int(poses.x) * JOINTS + joint), 0));
  vec4 b = vec4(texelFetch(turns, texel(int(poses.y) * JOINTS + joint), 0));
  return normalize(mix(a, dot(a, b) < 0.0 ? -b : b, poses.z));
}
vec3 placed(int joint) {
  vec3 at = mix(texelFetch(hips, texel(int(poses.x)), 0).xyz, texelFetch(hips, texel(int(poses.y)), 0).xyz, poses.z);
  for (int k = joint; parents[k] >= 0; k = parents[k]) at += rotated(turned(parents[k]), offsets[k]) * person.x;
  return at;
}
`;
const NORMAL = `
ivec4 movers = ivec4(skinIndex);
vec4 moves[4];
vec3 objectNormal = vec3(0.0);
for (int k = 0; k < 4; k++) {
  moves[k] = turned(movers[k]);
  objectNormal += rotated(moves[k], normal) * skinWeight[k];
}
objectNormal = normalize(objectNormal);
`;
const PLACE = `
vec3 transformed = vec3(0.0);
for (int k = 0; k < 4; k++)
  if (skinWeight[k] > 0.0)
    transformed += (placed(movers[k]) + rotated(moves[k], position - rests[movers[k]]) * person.x) * skinWeight[k];
#ifdef REGIONS
vLook = looks[int(person.y) * REGIONS + int(_region)];
if (vLook.r < 0.0) transformed = placed(0);
#endif
`;

/** The baked people of a file. Put the crowd into the node `World`. */
export class BakedCrowd extends THREE.Group {
  /** Reads the people of what GLTFLoader loaded. */
  static async of(gltf) {
    const { parser } = gltf, { extras } = parser.json.asset, baked = extras['throng.baked'];
    if (!baked) throw new Error('the file has no baked people: write it with `throng run SCENE --figures baked -o run.glb`');
    const view = (at) => parser.getDependency('bufferView', at);
    const [times, hips, turns] = await Promise.all([view(extras['throng.times']), view(baked.hips), view(baked.rotations)]);
    const levels = await Promise.all(baked.bodies.map((body) => Promise.all(body.levels.map((at) => parser.getDependency('mesh', at)))));
    return new BakedCrowd(baked, new Float64Array(times), new Float32Array(hips), new Int16Array(turns), levels);
  }

  constructor(baked, times, hips, turns, levels) {
    super();
    this.name = 'People';
    /** Distances from the camera up to which each level of detail is drawn, metres. */
    this.levels = [8, 25, 60, Infinity];
    this.people = baked.people;
    this.times = times;
    this.duration = times.length ? times[times.length - 1] - times[0] : 0;
    this.hips = hips;
    const texture = (from, parts, Kind, ...formats) => {
      const count = from.length / parts, height = Math.max(1, Math.ceil(count / WIDTH)), data = new Kind(4 * WIDTH * height);
      if (parts === 4) data.set(from);
      else for (let k = 0; k < count; k++) data.set(from.subarray(3 * k, 3 * k + 3), 4 * k);
      const made = new THREE.DataTexture(data, WIDTH, height, ...formats);
      made.needsUpdate = true;
      return made;
    };
    const ofTurns = texture(turns, 4, Int16Array, THREE.RGBAIntegerFormat, THREE.ShortType);
    ofTurns.internalFormat = 'RGBA16I';
    const ofHips = texture(hips, 3, Float32Array, THREE.RGBAFormat, THREE.FloatType);
    // a colour below 0 stands for a region that a look does not wear
    const looks = baked.looks.flat().map((rgb) => new THREE.Vector3(...(rgb ?? [-1, -1, -1])));
    const regions = baked.looks[0].length;
    this.parts = baked.bodies.map(({ offsets, figure }, body) => {
      const own = offsets.map((offset) => new THREE.Vector3(...offset)), rests = figure?.rests.map((rest) => new THREE.Vector3(...rest)) ?? [];
      if (!figure) own.forEach((offset, k) => rests.push(baked.parents[k] < 0 ? offset : rests[baked.parents[k]].clone().add(offset)));
      // bodies of files have colours of their own and no looks
      const material = new THREE.MeshStandardMaterial({ roughness: 0.85, vertexColors: !!figure });
      material.defines = { JOINTS: own.length, COLOURS: looks.length, ...(figure ? {} : { REGIONS: regions }) };
      material.onBeforeCompile = (shader) => {
        const known = { turns: ofTurns, hips: ofHips, parents: baked.parents, offsets: own, rests, looks };
        for (const [name, value] of Object.entries(known)) shader.uniforms[name] = { value };
        shader.vertexShader = VERTEX + shader.vertexShader.replace('#include <beginnormal_vertex>', NORMAL).replace('#include <begin_vertex>', PLACE);
        if (!figure) shader.fragmentShader = 'in vec3 vLook;\n' + shader.fragmentShader
          .replace('#include <color_fragment>', 'diffuseColor.rgb *= vLook;');
      };
      const most = baked.people.filter((person) => person.body === body).length;
      return levels[body].map(({ geometry }) => {
        const instanced = new THREE.InstancedBufferGeometry();
        instanced.index = geometry.index;
        for (const name in geometry.attributes) instanced.setAttribute(name, geometry.attributes[name]);
        instanced.setAttribute('poses', new THREE.InstancedBufferAttribute(new Float32Array(3 * most), 3));
        instanced.setAttribute('person', new THREE.InstancedBufferAttribute(new Float32Array(2 * most), 2));
        const mesh = new THREE.Mesh(instanced, material);
        // the processor does not know where the people are
        mesh.frustumCulled = false;
        this.add(mesh);
        return instanced;
      });
    });
  }

  /** The numbers of the poses before and after a second, and the share of the way; undefined while the person is not there. */
  poses(person, frame) {
    const visit = person.visits.findLast(([first]) => first <= frame);
    if (!visit || frame >= visit[0] + visit[1]) return undefined;
    const at = frame - visit[0], before = Math.floor(at);
    return [visit[2] + before, visit[2] + Math.min(before + 1, visit[1] - 1), at - before];
  }

  /** The frame of a second: a whole number and the share of the way to the next. */
  frame(second) {
    const time = this.times[0] + second;
    let [low, high] = [0, this.times.length - 1];
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (this.times[middle] <= time) low = middle;
      else high = middle - 1;
    }
    const whole = this.times[low + 1] - this.times[low];
    return low + (whole > 0 ? Math.min(Math.max((time - this.times[low]) / whole, 0), 1 - 1e-6) : 0);
  }

  /** Moves all people to a second. The distance from the camera selects the levels. Returns the number of people. */
  update(second, camera) {
    const frame = this.frame(second), eye = this.worldToLocal(camera.position.clone());
    const counts = this.parts.map((levels) => levels.map(() => 0));
    let there = 0;
    for (const person of this.people) {
      const poses = this.poses(person, frame);
      if (!poses) continue;
      const [x, y, z] = this.hips.subarray(3 * poses[0], 3 * poses[0] + 3);
      const body = this.parts[person.body], far = Math.hypot(x - eye.x, y - eye.y, z - eye.z);
      const level = Math.min(this.levels.findIndex((most) => far <= most), body.length - 1);
      const { poses: moving, person: fixed } = body[level].attributes, at = counts[person.body][level]++;
      moving.setXYZ(at, ...poses);
      fixed.setXY(at, person.height, person.look ?? 0);
      there += 1;
    }
    this.parts.forEach((levels, body) => levels.forEach((geometry, level) => {
      geometry.instanceCount = counts[body][level];
      geometry.attributes.poses.needsUpdate = true;
      geometry.attributes.person.needsUpdate = true;
    }));
    return there;
  }

  /** The middle of the people at a second, and the distance within which half of them are. */
  ball(second) {
    const frame = this.frame(second), places = this.people.map((person) => this.poses(person, frame)).filter(Boolean)
      .map(([pose]) => new THREE.Vector3().fromArray(this.hips, 3 * pose));
    const center = places.reduce((sum, place) => sum.add(place), new THREE.Vector3()).divideScalar(Math.max(places.length, 1));
    const far = places.map((place) => place.distanceTo(center)).sort((a, b) => a - b);
    return { center, radius: far[far.length >> 1] ?? 5 };
  }
}
