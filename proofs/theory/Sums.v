(** * Sums over lists

    Claim.  Sums over the elements of a list are linear and obey the triangle
    inequality; a sum over pairs is a sum of sums.

    Assumptions.  None: the lists are finite and may be empty.

    A quadrature rule is a list of nodes and weights, and a nested rule sums over
    panels and, in each panel, over nodes.  This file lets the others do so. *)

From Coq Require Import Reals Lra Lia List.
Import ListNotations.
Open Scope R_scope.

Definition sum_over {A : Type} (l : list A) (f : A -> R) : R :=
  fold_right (fun x sum => f x + sum) 0 l.

Section Sums.
Context {A B : Type}.

Lemma sum_over_ext (l : list A) (f g : A -> R) :
  (forall x, In x l -> f x = g x) -> sum_over l f = sum_over l g.
Proof.
  induction l as [| y l IH]; simpl; intros H; [easy |].
  rewrite (H y), IH; auto.
Qed.

Lemma sum_over_scal (l : list A) (k : R) (f : A -> R) :
  sum_over l (fun x => k * f x) = k * sum_over l f.
Proof. induction l as [| y l IH]; simpl; [| rewrite IH]; ring. Qed.

Lemma sum_over_plus (l : list A) (f g : A -> R) :
  sum_over l f + sum_over l g = sum_over l (fun x => f x + g x).
Proof. induction l as [| y l IH]; simpl; [| rewrite <- IH]; ring. Qed.

Lemma sum_over_minus (l : list A) (f g : A -> R) :
  sum_over l f - sum_over l g = sum_over l (fun x => f x - g x).
Proof. induction l as [| y l IH]; simpl; [| rewrite <- IH]; ring. Qed.

Lemma sum_over_le (l : list A) (f g : A -> R) :
  (forall x, In x l -> f x <= g x) -> sum_over l f <= sum_over l g.
Proof.
  induction l as [| y l IH]; simpl; intros H; [lra |].
  apply Rplus_le_compat; auto.
Qed.

Lemma sum_over_nonnegative (l : list A) (f : A -> R) :
  (forall x, In x l -> 0 <= f x) -> 0 <= sum_over l f.
Proof.
  induction l as [| y l IH]; simpl; intros H; [lra |].
  apply Rplus_le_le_0_compat; auto.
Qed.

Lemma sum_over_abs (l : list A) (f : A -> R) :
  Rabs (sum_over l f) <= sum_over l (fun x => Rabs (f x)).
Proof.
  induction l as [| y l IH]; simpl; [rewrite Rabs_R0; lra |].
  eapply Rle_trans; [apply Rabs_triang | lra].
Qed.

Lemma sum_over_app (l m : list A) (f : A -> R) :
  sum_over (l ++ m) f = sum_over l f + sum_over m f.
Proof. induction l as [| y l IH]; simpl; [| rewrite IH]; ring. Qed.

Lemma sum_over_map (l : list A) (g : A -> B) (f : B -> R) :
  sum_over (map g l) f = sum_over l (fun x => f (g x)).
Proof. induction l as [| y l IH]; simpl; [| rewrite IH]; easy. Qed.
End Sums.

Lemma sum_over_pairs {A B : Type} (l : list A) (m : list B) (f : A * B -> R) :
  sum_over (list_prod l m) f = sum_over l (fun x => sum_over m (fun y => f (x, y))).
Proof.
  induction l as [| x l IH]; simpl; [easy |].
  now rewrite sum_over_app, sum_over_map, IH.
Qed.


(** Sums over 0, 1, ..., n - 1. *)
Lemma sum_over_seq_S (n : nat) (f : nat -> R) :
  sum_over (seq 0 (S n)) f = sum_over (seq 0 n) f + f n.
Proof. rewrite seq_S, sum_over_app. simpl. ring. Qed.

Lemma sum_over_seq_constant (n : nat) (k : R) : sum_over (seq 0 n) (fun _ => k) = INR n * k.
Proof.
  induction n as [| n IH]; [simpl; ring |].
  rewrite sum_over_seq_S, IH, S_INR. ring.
Qed.
