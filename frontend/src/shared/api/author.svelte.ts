// Whose changes those of this browser are: a name as its owner says it, empty for the server's own.
export class Author {
  name = $state('')

  constructor(name: string) {
    this.name = name
  }
}
