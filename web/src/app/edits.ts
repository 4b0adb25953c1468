// Edits of a world that can be undone. Several can be combined into one.

export interface Edit {
  name: string; // such as "move pebble"
  apply(): Promise<void>;
  revert(): Promise<void>;
}

// Performs the edits in this order. If an edit is refused, undoes the earlier edits and throws the
// error.
export function inOrder(name: string, edits: readonly Edit[]): Edit {
  const run = async (list: readonly Edit[], forth: "apply" | "revert", back: "apply" | "revert") => {
    const done: Edit[] = [];
    for (const edit of list) {
      try {
        await edit[forth]();
        done.unshift(edit);
      } catch (error) {
        for (const each of done) await each[back]();
        throw error;
      }
    }
  };
  return {
    name,
    apply: () => run(edits, "apply", "revert"),
    revert: () => run([...edits].reverse(), "revert", "apply"),
  };
}

// Performs the edits in an order that the server allows. An edit fails if another body still
// occupies the new place of its body. A failed edit is tried again after the other edits.
export function together(name: string, edits: readonly Edit[]): Edit {
  const run = async (list: readonly Edit[], forth: "apply" | "revert", back: "apply" | "revert") => {
    const done: Edit[] = [];
    let open = [...list];
    while (open.length > 0) {
      const refused: Edit[] = [];
      let reason: unknown;
      for (const edit of open) {
        try {
          await edit[forth]();
          done.unshift(edit);
        } catch (error) {
          refused.push(edit);
          reason ??= error;
        }
      }
      if (refused.length === open.length) {
        for (const each of done) await each[back]();
        throw reason;
      }
      open = refused;
    }
  };
  return {
    name,
    apply: () => run(edits, "apply", "revert"),
    revert: () => run([...edits].reverse(), "revert", "apply"),
  };
}
