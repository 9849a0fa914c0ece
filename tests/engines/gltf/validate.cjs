// SPDX-License-Identifier: Apache-2.0
// node validate.cjs FOLDER_WITH_NODE_MODULES FILE.gltf
// Prints the Khronos validator's counts and messages as JSON; exits 1 on any error or warning.
const fs = require('fs');
const [, , modules, file] = process.argv;
const validator = require(require.resolve('gltf-validator', { paths: [modules] }));
validator
  .validateBytes(new Uint8Array(fs.readFileSync(file)), { uri: file, maxIssues: 0 })
  .then((report) => {
    const { numErrors, numWarnings, numInfos, messages } = report.issues;
    console.log(JSON.stringify({ version: report.validatorVersion, numErrors, numWarnings, numInfos, messages }));
    process.exit(numErrors + numWarnings === 0 ? 0 : 1);
  })
  .catch((error) => {
    console.error(String(error));
    process.exit(2);
  });
