// Khronos' validator finds no errors and no warnings: node validate.mjs FILE.glb ...
//
// Needs gltf-validator, in the folder `node_modules` that VALIDATOR names.
import fs from 'node:fs';
import path from 'node:path';
import { createRequire } from 'node:module';

const validator = createRequire(path.resolve(process.env.VALIDATOR ?? '.', 'x'))('gltf-validator');
for (const file of process.argv.slice(2)) {
  const { issues, info } = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)), { maxIssues: 100 });
  const wrong = issues.messages.filter(({ severity }) => severity < 2);
  if (issues.numErrors + issues.numWarnings > 0) throw new Error(`${file}: ${JSON.stringify(wrong, null, 1)}`);
  console.log(`${file}: valid, ${info.animationCount} animations, ${info.totalVertexCount} vertices, ${issues.numInfos} remarks`);
}
