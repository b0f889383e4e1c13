// What was dropped or chosen, also complete folders: the files within, without those a system
// hides.

/** Files of a drop; folders are gone through. */
export async function droppedFiles(transfer: DataTransfer | null): Promise<File[]> {
  // The list is empty after the first wait: entries are taken at once.
  const entries = [...(transfer?.items ?? [])]
    .map((item) => item.webkitGetAsEntry?.() ?? null)
    .filter((entry) => entry !== null)
  if (!entries.some((entry) => entry.isDirectory)) return [...(transfer?.files ?? [])]
  const files = await Promise.all(entries.map(filesOf))
  return shownFiles(files.flat())
}

/** Without files of the system such as `.DS_Store`. */
export const shownFiles = (files: Iterable<File>): File[] =>
  [...files].filter(({ name }) => !name.startsWith('.'))

async function filesOf(entry: FileSystemEntry): Promise<File[]> {
  if (entry.isFile) {
    return [await new Promise((done, fail) => (entry as FileSystemFileEntry).file(done, fail))]
  }
  const reader = (entry as FileSystemDirectoryEntry).createReader()
  const files: File[] = []
  // A reader gives a hundred at a time, and none at the end.
  for (;;) {
    const some = await new Promise<FileSystemEntry[]>((done, fail) => {
      reader.readEntries(done, fail)
    })
    if (some.length === 0) return files
    files.push(...(await Promise.all(some.map(filesOf))).flat())
  }
}
