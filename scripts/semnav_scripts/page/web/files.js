// Files that the visitor keeps, and files that the visitor drops.

/** Save a binary message: a line with the name of a file in JSON, then its content. Returns its name. */
export async function save(blob) {
  const start = await blob.slice(0, 1000).arrayBuffer();
  const end = new Uint8Array(start).indexOf(10);
  const { name } = JSON.parse(new TextDecoder().decode(start.slice(0, end)));
  const link = Object.assign(document.createElement("a"), { href: URL.createObjectURL(blob.slice(end + 1)), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60000);
  return `${name}: ${Math.max(1, Math.round(blob.size / 1024))} KB`;
}

/** A file as a binary message. */
export function message(file) {
  return new Blob([`${JSON.stringify({ name: file.name })}\n`, file]);
}

/** Call `use` with a file that is dropped anywhere on the page. */
export function onDrop(use) {
  const holdsFile = (event) => event.dataTransfer?.types.includes("Files");
  document.ondragover = (event) => {
    if (!holdsFile(event)) return;
    event.preventDefault();
    document.body.classList.add("dropping");
  };
  document.ondragleave = (event) => event.relatedTarget || document.body.classList.remove("dropping");
  document.ondrop = (event) => {
    if (!holdsFile(event)) return;
    event.preventDefault();
    document.body.classList.remove("dropping");
    use(event.dataTransfer.files[0]);
  };
}
