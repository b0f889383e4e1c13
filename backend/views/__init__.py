"""What a person looks at: min/max traces to pixel width, figures, reports."""
