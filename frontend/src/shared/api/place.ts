// Addresses are relative to where the server is, which a proxy may have put below a path of its
// site: the entry page's <base> says where. "rides/7" is a place; "." is the first page.

/** The place of a path of the site: "/spindle/rides/7" is "rides/7" below "/spindle/". */
export function placeOf(path: string, root = new URL(document.baseURI).pathname): string {
  if (`${path}/` === root) return ''
  return path.slice(path.startsWith(root) ? root.length : 1)
}

/** The place of the page that is shown. */
export const here = (): string => placeOf(location.pathname)
