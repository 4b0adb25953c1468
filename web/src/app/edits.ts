// Edits of a world: each can be taken back, and several can be one.

export interface Edit {
  name: string; // "move pebble"
  apply(): Promise<void>;
  revert(): Promise<void>;
}

// One after the other. If one is refused, those before it are taken back, and the refusal is thrown.
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

// In any order that the server allows: one that is refused, since another body still stands there, is tried
// again after the others.
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
