// three.js out of its pack: its module and the controls, which import it by a name that is no address, as blobs.
async function importThree() {
  const { arrays } = await unpack("three");
  const text = (name) => new TextDecoder().decode(arrays[name].values);
  const address = (source) => URL.createObjectURL(new Blob([source], { type: "text/javascript" }));
  const three = address(text("module"));
  const controls = address(text("controls").replaceAll("from 'three'", `from '${three}'`));
  const [THREE, { OrbitControls }] = await Promise.all([import(three), import(controls)]);
  return { THREE, OrbitControls };
}
